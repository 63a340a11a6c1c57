// Shapes that tests share.
#pragma once

#include <cmath>

#include "base/random.h"
#include "rholm/mesh.h"
#include "rholm/primitives.h"

namespace rholm::test {

// A rotation without special angles.
inline Vec3 rotated(const Vec3& u) {
  const double a = 0.6, b = 1.3;
  const Vec3 v = {std::cos(a) * u.x - std::sin(a) * u.y, std::sin(a) * u.x + std::cos(a) * u.y,
                  u.z};
  return {std::cos(b) * v.x + std::sin(b) * v.z, v.y, -std::sin(b) * v.x + std::cos(b) * v.z};
}

inline Mesh rotated(Mesh mesh) {
  for (Vec3& v : mesh.vertices) v = rotated(v);
  return mesh;
}

// Vertices on both poles and four on the equator, edges through the poles, random radii.
inline Mesh random_octahedron(std::uint64_t seed) {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::size_t i = 0; i < 6; ++i) mesh.vertices[i] *= 0.6 + random_uniform(seed, i);
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                    {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  return mesh;
}

}  // namespace rholm::test
