// Random star-shaped bodies that are hard to integrate: errors of their faces may have one sign.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.h"
#include "rholm/mesh.h"
#include "rholm/primitives.h"
#include "rholm/rotate.h"
#include "support/star_polyhedra.h"

namespace rholm::test {

// Numbers in [0, 1) that determine a body. Similar numbers give similar bodies.
struct BodyGenes {
  std::array<double, 16> u = {};
};

inline BodyGenes random_genes(std::uint64_t seed) {
  BodyGenes genes;
  for (std::size_t i = 0; i < genes.u.size(); ++i) genes.u[i] = random_uniform(seed, i);
  return genes;
}

// Changes some of the numbers at random; the family of the body stays the same.
inline BodyGenes mutated(BodyGenes genes, std::uint64_t seed) {
  const double size = std::pow(10.0, -3 * random_uniform(seed, 0));
  for (std::size_t i = 1; i < genes.u.size(); ++i) {
    if (random_uniform(seed, 3 * i) < 0.6) continue;
    const double step = size * (2 * random_uniform(seed, 3 * i + 1) - 1);
    genes.u[i] = std::clamp(genes.u[i] + step, 0.0, std::nextafter(1.0, 0.0));
  }
  return genes;
}

struct RandomBody {
  std::string family;
  Mesh mesh;
  Vec3 center;  // sees the whole surface
  int degree = 0;
  double precision = 0;
};

namespace random_bodies {

inline double between(double low, double high, double u) { return low + (high - low) * u; }
inline double log_between(double low, double high, double u) {
  return low * std::pow(high / low, u);
}
inline int whole(double low, double high, double u) {
  return static_cast<int>(std::lround(log_between(low, high, u)));
}

// Joins rings of equally many points, from the top down; caps are fans about points on the axis.
inline Mesh of_rings(const std::vector<std::vector<Vec3>>& rings, double top, double bottom) {
  Mesh mesh;
  mesh.vertices.push_back({0, 0, top});
  for (const std::vector<Vec3>& ring : rings) {
    mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
  }
  mesh.vertices.push_back({0, 0, bottom});
  const auto n = static_cast<std::uint32_t>(rings[0].size());
  const auto m = static_cast<std::uint32_t>(rings.size());
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.faces.push_back({0, 1 + i, 1 + j});
    for (std::uint32_t k = 0; k + 1 < m; ++k) {
      const std::uint32_t a = 1 + k * n, b = a + n;
      mesh.faces.push_back({a + i, b + i, a + j});
      mesh.faces.push_back({a + j, b + i, b + j});
    }
    mesh.faces.push_back({last, 1 + (m - 1) * n + j, 1 + (m - 1) * n + i});
  }
  return mesh;
}

inline std::vector<Vec3> ring(int n, double radius, double z) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double phi = 2 * std::numbers::pi * i / n;
    points.push_back({radius * std::cos(phi), radius * std::sin(phi), z});
  }
  return points;
}

inline Mesh prism(const BodyGenes& g) {
  const int n = whole(3, 2000, g.u[1]), layers = whole(1, n > 200 ? 4 : 40, g.u[2]);
  const double radius = log_between(0.01, 10, g.u[3]);
  std::vector<std::vector<Vec3>> rings;
  for (int k = 0; k <= layers; ++k) rings.push_back(ring(n, radius, 1 - 2.0 * k / layers));
  return of_rings(rings, 1, -1);
}

// Returns a gear of outer radius 1. `depth` is the depth of its gaps. `wall` is the angle that a
// wall takes as seen from the axis, in teeth.
inline Mesh gear(int teeth, int layers, double height, double depth, double wall) {
  std::vector<Vec3> outline;
  for (int i = 0; i < teeth; ++i) {
    const double tooth = 2 * std::numbers::pi / teeth;
    for (const auto& [share, radius] :
         {std::pair{0.0, 1.0}, std::pair{0.5 - wall, 1.0}, std::pair{0.5, 1 - depth},
          std::pair{1 - wall, 1 - depth}}) {
      const double phi = tooth * (i + share);
      outline.push_back({radius * std::cos(phi), radius * std::sin(phi), 0});
    }
  }
  std::vector<std::vector<Vec3>> rings;
  for (int k = 0; k <= layers; ++k) {
    rings.push_back(outline);
    for (Vec3& x : rings.back()) x.z = height * (0.5 - 1.0 * k / layers);
  }
  return of_rings(rings, height / 2, -height / 2);
}

inline Mesh gear(const BodyGenes& g) {
  return gear(whole(4, 64, g.u[1]), whole(1, 40, g.u[2]), log_between(0.02, 3, g.u[3]),
              between(0.05, 0.5, g.u[4]), log_between(1e-5, 0.2, g.u[5]));
}

inline Mesh cone(const BodyGenes& g) {
  const int n = whole(3, 1000, g.u[1]);
  return of_rings({ring(n, 1, 0)}, log_between(0.02, 50, g.u[2]), -log_between(0.02, 50, g.u[3]));
}

inline Mesh terraces(const BodyGenes& g) {
  const int n = whole(4, 64, g.u[1]), steps = whole(2, 12, g.u[2]);
  const double height = log_between(0.1, 10, g.u[3]), slope = log_between(1e-4, 0.1, g.u[4]);
  std::vector<std::vector<Vec3>> rings;
  for (int k = 0; k < steps; ++k) {  // walls and treads are inclined by `slope` times a step
    const double radius = (k + 1.0) / steps, z = height * (1 - 1.0 * k / steps);
    rings.push_back(ring(n, radius - slope / steps, z));
    rings.push_back(ring(n, radius, z - height * (1 - slope) / steps));
  }
  return of_rings(rings, height * (1 + slope), -log_between(0.05, 2, g.u[5]));
}

inline Mesh ellipsoid_of(const BodyGenes& g) {
  return ellipsoid({1, log_between(0.3, 1, g.u[2]), log_between(1, 100, g.u[3])},
                   static_cast<int>(between(1, 7, g.u[1])));
}

inline Mesh rough_sphere(const BodyGenes& g) {
  Mesh mesh = icosphere(static_cast<int>(between(0, 5, g.u[1])));
  const double roughness = log_between(1e-3, 0.6, g.u[2]);
  const auto seed = static_cast<std::uint64_t>(1e6 * g.u[3]);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] *= 1 + roughness * (2 * random_uniform(seed, i) - 1);
  }
  return mesh;
}

inline Mesh box_of(const BodyGenes& g) {
  return box({1, log_between(1e-3, 1, g.u[1]), log_between(1, 30, g.u[2])}, whole(1, 16, g.u[3]));
}

inline Mesh polyhedron(const BodyGenes& g) {
  return star_polyhedron(static_cast<std::size_t>(whole(1, 199, g.u[1]) - 1),
                         between(0, 0.6, g.u[2]), between(0, 0.95, g.u[3]),
                         static_cast<std::uint64_t>(1e6 * g.u[4]));
}

// Returns a point near a corner, the middle of an edge or the middle of a face of a convex body.
inline Vec3 near_surface(const Mesh& mesh, const BodyGenes& g) {
  const auto n = static_cast<double>(mesh.faces.size());
  const Triangle& t = mesh.faces[static_cast<std::size_t>(n * g.u[8])];
  const int corners = 1 + static_cast<int>(3 * g.u[9]);
  Vec3 at;
  for (int i = 0; i < corners; ++i) at += mesh.vertices[t[i]] / corners;
  return (1 - log_between(1e-6, 1, g.u[10])) * at;
}

}  // namespace random_bodies

inline RandomBody random_body(const BodyGenes& g) {
  namespace make = random_bodies;
  struct Family {
    const char* name;
    Mesh (*mesh)(const BodyGenes&);
    bool convex;
  };
  constexpr std::array kFamilies = {Family{"prism", make::prism, true},
                                    Family{"gear", make::gear, false},
                                    Family{"double cone", make::cone, true},
                                    Family{"terraces", make::terraces, false},
                                    Family{"ellipsoid", make::ellipsoid_of, true},
                                    Family{"rough sphere", make::rough_sphere, false},
                                    Family{"box", make::box_of, true},
                                    Family{"polyhedron", make::polyhedron, false}};
  const Family& family = kFamilies[static_cast<std::size_t>(kFamilies.size() * g.u[0])];
  RandomBody body{.family = family.name, .mesh = family.mesh(g), .center = {}};
  if (family.convex && g.u[7] < 0.4) body.center = make::near_surface(body.mesh, g);
  // One half of the bodies is turned; the other half is aligned with the axes.
  Rotation rotation;
  if (g.u[6] < 0.5) {
    rotation = rotation_of(EulerAngles{6.2 * g.u[11], std::acos(2 * g.u[12] - 1), 12 * g.u[6]});
  }
  const double size = make::log_between(1e-3, 1e6, g.u[13]);
  for (Vec3& v : body.mesh.vertices) v = size * rotate(v, rotation);
  body.center = size * rotate(body.center, rotation);
  // The degree is limited so that direct sums take at most some seconds.
  const double faces = static_cast<double>(body.mesh.faces.size());
  const double most = std::clamp(std::sqrt(3e6 / faces), 4.0, 128.0);
  body.degree = make::whole(2, most, g.u[14]);
  body.precision = std::pow(10.0, -3 - 2 * std::floor(4 * g.u[15]));
  return body;
}

}  // namespace rholm::test
