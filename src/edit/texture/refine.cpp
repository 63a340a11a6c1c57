#include "edit/texture/refine.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include <fmt/format.h>

#include "rholm/error.h"

namespace rholm {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;
constexpr int kMostPasses = 24;

using Key = std::uint64_t;  // smaller vertex << 32 | larger

Key key_of(std::uint32_t a, std::uint32_t b) {
  return static_cast<Key>(std::min(a, b)) << 32 | std::max(a, b);
}

// Weighted as by Max (1999), exact on spheres: adjacent triangles of
// different sizes, which splitting makes, do not tilt the normals.
std::vector<Vec3> vertex_normals(const Mesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size());
  for (const Triangle& t : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& at = mesh.vertices[t[k]];
      const Vec3 a = mesh.vertices[t[(k + 1) % 3]] - at, b = mesh.vertices[t[(k + 2) % 3]] - at;
      const double squares = dot(a, a) * dot(b, b);
      if (squares > 0) normals[t[k]] += cross(a, b) / squares;
    }
  }
  for (Vec3& n : normals) n = normalized(n);
  return normals;
}

std::vector<Key> long_edges(const Mesh& mesh, const std::vector<double>& weights, double length) {
  std::vector<Key> edges;
  for (const Triangle& t : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (a == b || !(std::max(weights[a], weights[b]) > 0)) continue;
      if (norm(mesh.vertices[a] - mesh.vertices[b]) > length) edges.push_back(key_of(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

void add_middle(const std::vector<Vec3>& normals, Key edge, Mesh& mesh,
                std::vector<double>& weights) {
  const auto a = static_cast<std::uint32_t>(edge >> 32), b = static_cast<std::uint32_t>(edge);
  const Vec3 along = mesh.vertices[b] - mesh.vertices[a];
  Vec3 middle = 0.5 * (mesh.vertices[a] + mesh.vertices[b]);
  if (std::min(weights[a], weights[b]) > 0) {
    middle -= 0.125 * (dot(along, normals[a]) * normals[a] - dot(along, normals[b]) * normals[b]);
  }
  mesh.vertices.push_back(middle);
  weights.push_back(0.5 * (weights[a] + weights[b]));
  for (Attribute& attribute : mesh.attributes) {
    const double mean = 0.5 * (attribute.values[a] + attribute.values[b]);
    const bool whole =
        attribute.type != ScalarType::kFloat32 && attribute.type != ScalarType::kFloat64;
    attribute.values.push_back(whole ? std::floor(mean) : mean);
  }
}

// Replaces a triangle whose edges k -> k + 1 have new vertices m[k], or kNone.
void split(const Triangle& t, const std::array<std::uint32_t, 3>& m, const Mesh& mesh,
           std::vector<Triangle>& out) {
  const int n_split = (m[0] != kNone) + (m[1] != kNone) + (m[2] != kNone);
  if (n_split == 0) {
    out.push_back(t);
  } else if (n_split == 3) {
    out.insert(out.end(), {{t[0], m[0], m[2]}, {m[0], t[1], m[1]}, {m[2], m[1], t[2]}, m});
  } else if (n_split == 1) {
    const std::size_t k = m[0] != kNone ? 0 : m[1] != kNone ? 1 : 2;
    const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
    out.insert(out.end(), {{a, m[k], c}, {m[k], b, c}});
  } else {
    // The two split edges meet at b; the other quadrilateral has two diagonals.
    const std::size_t k = m[0] == kNone ? 1 : m[1] == kNone ? 2 : 0;
    const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
    const std::uint32_t ab = m[k], bc = m[(k + 1) % 3];
    out.push_back({ab, b, bc});
    if (norm(mesh.vertices[a] - mesh.vertices[bc]) < norm(mesh.vertices[ab] - mesh.vertices[c])) {
      out.insert(out.end(), {{a, ab, bc}, {a, bc, c}});
    } else {
      out.insert(out.end(), {{a, ab, c}, {ab, bc, c}});
    }
  }
}

[[noreturn]] void refuse(double length) {
  throw Error(
      ErrorCode::kInvalidInput,
      fmt::format("edges of {:g} would need more than {} vertices; take a larger scale or a "
                  "coarser source",
                  length, kMostRefined));
}

// Throws before the work, not when memory is full. With edges up to `length` no
// triangle is larger than the equilateral one, and there are two triangles per vertex.
void check_size(const Mesh& mesh, const std::vector<double>& weights, double length) {
  double area = 0;
  for (const Triangle& t : mesh.faces) {
    if (!(std::max({weights[t[0]], weights[t[1]], weights[t[2]]}) > 0)) continue;
    const Vec3& a = mesh.vertices[t[0]];
    area += norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a)) / 2;
  }
  const double largest = std::sqrt(3.) / 4 * length * length;
  if (!(area / largest / 2 <= static_cast<double>(kMostRefined))) refuse(length);
}

}  // namespace

void refine(Mesh& mesh, std::vector<double>& weights, double length) {
  check_size(mesh, weights, length);
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const std::vector<Key> edges = long_edges(mesh, weights, length);
    if (edges.empty()) return;
    const auto first = mesh.vertices.size();
    if (first + edges.size() > kMostRefined) refuse(length);
    const std::vector<Vec3> normals = vertex_normals(mesh);
    for (const Key edge : edges) add_middle(normals, edge, mesh, weights);
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.faces.size() + 2 * edges.size());
    for (const Triangle& t : mesh.faces) {
      std::array<std::uint32_t, 3> middles;
      for (std::size_t k = 0; k < 3; ++k) {
        const Key key = key_of(t[k], t[(k + 1) % 3]);
        const auto found = std::lower_bound(edges.begin(), edges.end(), key);
        middles[k] = found != edges.end() && *found == key
                         ? static_cast<std::uint32_t>(
                               first + static_cast<std::size_t>(found - edges.begin()))
                         : kNone;
      }
      split(t, middles, mesh, triangles);
    }
    mesh.faces = std::move(triangles);
  }
}

}  // namespace rholm
