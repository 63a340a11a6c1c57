// Shapes that several tests use.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "rholm/mesh.h"
#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "support/random_data.h"

namespace rholm::test {

// Applies a rotation without special angles.
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

// Returns a torus whose tube is narrower at one place, by the factor `narrow`.
inline Mesh ring_with_neck(double narrow) {
  Mesh ring = torus(2, 0.5, 400, 50);
  for (Vec3& v : ring.vertices) {
    const double phi = std::atan2(v.y, v.x);
    const Vec3 middle{2 * std::cos(phi), 2 * std::sin(phi), 0};
    v = middle + std::min(1.0, std::hypot(narrow, 16 * phi)) * (v - middle);
  }
  return ring;
}

// Returns a sphere of random radii, so that every edge is a crease.
inline Mesh rough_sphere(int subdivisions) {
  Mesh mesh = icosphere(subdivisions);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] *= random_in(0.8, 1.2, 5, i);
  }
  return mesh;
}

// Vertices are both poles and four points of the equator, with random radii; edges meet the poles.
inline Mesh random_octahedron(std::uint64_t seed) {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::size_t i = 0; i < 6; ++i) mesh.vertices[i] *= 0.6 + random_uniform(seed, i);
  mesh.faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  return mesh;
}

// Adds attributes nx, ny, nz: the mean normal of the triangles at each vertex.
inline void add_normals(Mesh& mesh) {
  const std::vector<Vec3> sums = area_normals(mesh.vertices, mesh.faces);
  std::vector<double> axes[3];
  for (const Vec3& sum : sums) {
    const Vec3 n = normalized(sum);
    axes[0].push_back(n.x), axes[1].push_back(n.y), axes[2].push_back(n.z);
  }
  const char* const names[3] = {"nx", "ny", "nz"};
  for (int k = 0; k < 3; ++k) mesh.attributes.push_back({names[k], ScalarType::kFloat32, axes[k]});
}

}  // namespace rholm::test
