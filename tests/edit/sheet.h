// Sheets for tests of edits: triangular grids over a plane, moved up or down by a function.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "rholm/mesh.h"

namespace rholm::test {

// Returns the bits of a vector, for comparisons to the last bit: -0 differs from 0.
inline std::array<std::uint64_t, 3> bits_of(const Vec3& x) {
  return std::bit_cast<std::array<std::uint64_t, 3>>(x);
}

// Equilateral triangles of side h, n x n pairs of them, with the middle at the origin.
template <class Height>
Mesh sheet(int n, double h, const Height& height) {
  Mesh mesh;
  const int middle = n / 2;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double x = (j - middle + 0.5 * (i % 2)) * h, y = (i - middle) * h * std::sqrt(0.75);
      mesh.vertices.push_back({x, y, height(x, y)});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (i % 2 == 0) {
        mesh.faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
        mesh.faces.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
      } else {
        mesh.faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
        mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
      }
    }
  }
  return mesh;
}

inline Mesh sheet(int n, double h) {
  return sheet(n, h, [](double, double) { return 0.0; });
}

}  // namespace rholm::test
