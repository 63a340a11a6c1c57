// Meshes for tests of queries, built here so that the tests do not rest on other code of the
// library.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/random.h"
#include "rholm/mesh.h"

namespace rholm::test {

inline Mesh cube() {
  Mesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.vertices.push_back({k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0});
  }
  mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

inline Vec3 random_point(std::uint64_t seed, std::uint64_t k) {
  return {2 * random_uniform(seed, 3 * k) - 1, 2 * random_uniform(seed, 3 * k + 1) - 1,
          2 * random_uniform(seed, 3 * k + 2) - 1};
}

// Returns unconnected triangles of very different sizes. Every fifth triangle has no area: it is a
// needle folded onto itself, or a point.
inline Mesh soup(std::uint64_t seed, std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t t = 0; t < n; ++t) {
    const Vec3 a = random_point(seed, std::uint64_t{3} * t);
    const double size = std::pow(10.0, -3 * random_uniform(seed + 1, t));
    Vec3 b = a + size * random_point(seed, 3 * t + 1);
    Vec3 c = a + size * random_point(seed, 3 * t + 2);
    if (t % 5 == 0) c = a + 0.5 * (b - a);
    if (t % 10 == 0) b = c = a;
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
    mesh.faces.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

}  // namespace rholm::test
