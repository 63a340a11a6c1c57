// Small meshes written out by hand, and motions of meshes.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "rholm/mesh.h"

namespace rholm::test {

// Corners are the origin and the unit points of the axes: volume 1/6, area 3/2 + sqrt(3)/2.
inline Mesh tetrahedron() {
  return {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          .faces = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}},
          .attributes = {}};
}

struct Point2 {
  double x = 0;
  double y = 0;
};

// Returns a prism, |z| <= height/2, over a counter-clockwise polygon; `apex` sees all its edges.
// Vertices are in the order bottom, top, apex of the bottom, apex of the top.
inline Mesh prism(const std::vector<Point2>& polygon, const Point2& apex, double height) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (const double z : {-height / 2, height / 2}) {
    for (const Point2& p : polygon) mesh.vertices.push_back({p.x, p.y, z});
  }
  mesh.vertices.push_back({apex.x, apex.y, -height / 2});
  mesh.vertices.push_back({apex.x, apex.y, height / 2});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.faces.push_back({i, j, n + j});
    mesh.faces.push_back({i, n + j, n + i});
    mesh.faces.push_back({2 * n, j, i});
    mesh.faces.push_back({2 * n + 1, n + i, n + j});
  }
  return mesh;
}

// An L with arms of length 4 and width 1; its kernel is [0, 1] x [0, 1] x [-height/2, height/2].
inline Mesh l_prism(double height) {
  return prism({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, {0.5, 0.5}, height);
}

// Returns the same surface with its vertices in the order `order`.
inline Mesh renumbered(const Mesh& mesh, const std::vector<std::uint32_t>& order) {
  Mesh result = mesh;
  std::vector<std::uint32_t> number(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    number[order[i]] = i;
    result.vertices[i] = mesh.vertices[order[i]];
  }
  for (Triangle& t : result.faces) {
    for (std::uint32_t& corner : t) corner = number[corner];
  }
  return result;
}

// Gives each triangle three vertices of its own.
inline Mesh exploded(const Mesh& mesh) {
  Mesh soup;
  for (const Triangle& t : mesh.faces) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t v : t) soup.vertices.push_back(mesh.vertices[v]);
    soup.faces.push_back({first, first + 1, first + 2});
  }
  return soup;
}

// Returns both meshes in one mesh, without a connection.
inline Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh both = a;
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  both.vertices.insert(both.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.faces) {
    both.faces.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return both;
}

// The map x -> scale * rotation(x) + shift.
struct Motion {
  double scale = 1;
  std::array<Vec3, 3> rows = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 shift;

  Vec3 operator()(const Vec3& x) const {
    return scale * Vec3{dot(rows[0], x), dot(rows[1], x), dot(rows[2], x)} + shift;
  }
};

// Returns the rotation by `angle` about an axis (Rodrigues' formula).
inline Motion rotation(const Vec3& axis, double angle) {
  const Vec3 k = normalized(axis);
  const double c = std::cos(angle), s = std::sin(angle);
  const auto image = [&](const Vec3& x) {
    return c * x + s * cross(k, x) + (1 - c) * dot(k, x) * k;
  };
  const Vec3 a = image({1, 0, 0}), b = image({0, 1, 0}), d = image({0, 0, 1});
  Motion motion;
  motion.rows = {Vec3{a.x, b.x, d.x}, Vec3{a.y, b.y, d.y}, Vec3{a.z, b.z, d.z}};
  return motion;
}

inline Mesh moved(Mesh mesh, const Motion& motion) {
  for (Vec3& v : mesh.vertices) v = motion(v);
  return mesh;
}

}  // namespace rholm::test
