// Random polyhedra that are star-shaped about the origin, steep and coarse.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "base/random.h"
#include "rholm/mesh.h"

namespace rholm::test {

inline Vec3 random_direction(std::uint64_t seed, std::uint64_t i) {
  const double z = 2 * random_uniform(seed, 2 * i) - 1;
  const double phi = 2 * std::numbers::pi * random_uniform(seed, 2 * i + 1);
  const double s = std::sqrt(1 - z * z);
  return {s * std::cos(phi), s * std::sin(phi), z};
}

// Returns the convex hull: each point outside is joined to the horizon that it sees. The first four
// points must not lie in a plane.
inline std::vector<Triangle> hull(const std::vector<Vec3>& p) {
  const auto sees = [&](const Triangle& t, const Vec3& x) {
    return dot(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]), x - p[t[0]]) > 1e-12;
  };
  std::vector<Triangle> faces = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  if (sees(faces[0], p[3])) {
    for (Triangle& t : faces) std::swap(t[1], t[2]);
  }
  for (std::uint32_t i = 4; i < p.size(); ++i) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::vector<Triangle> kept;
    for (const Triangle& t : faces) {
      if (!sees(t, p[i])) {
        kept.push_back(t);
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
    }
    for (const auto& [a, b] : edges) {
      if (!edges.contains({b, a})) kept.push_back({a, b, i});
    }
    faces = std::move(kept);
  }
  return faces;
}

// Returns a polyhedron with n + 4 vertices and 2n + 4 faces. Vertices of a convex hull are moved
// along their rays by up to the factor 1 -+ `roughness`, then stretched. The body is shifted at
// random by the part `offset` (below 1) of the way to where it is no longer star-shaped.
inline Mesh star_polyhedron(std::size_t n, double roughness, double offset, std::uint64_t seed) {
  std::vector<Vec3> p = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  for (Vec3& v : p) v = v / std::sqrt(3.0);
  for (std::uint64_t i = 0; i < n; ++i) p.push_back(random_direction(seed, i));
  Mesh mesh;
  mesh.faces = hull(p);
  const std::uint64_t other = seed + 1'000'000;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p[i] *= 1 + roughness * (2 * random_uniform(other, i) - 1);
  }
  for (Vec3& v : p) {
    v = {v.x * (0.5 + random_uniform(other, 1000)), v.y * (0.5 + random_uniform(other, 1001)), v.z};
  }
  const Vec3 toward = random_direction(other, 2000);
  double most = 1e3;
  for (const Triangle& t : mesh.faces) {
    const Vec3 normal = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    const double ahead = dot(normal, toward), distance = dot(normal, p[t[0]]);
    if (ahead > 0) most = std::min(most, distance / ahead);
  }
  for (Vec3& v : p) v = v - offset * most * toward;
  mesh.vertices = std::move(p);
  return mesh;
}

}  // namespace rholm::test
