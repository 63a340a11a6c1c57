#include <algorithm>
#include <array>

#include "base/cancel.h"
#include "base/disjoint_sets.h"
#include "rholm/topology.h"
#include "shape/coordinate_error.h"
#include "shape/face.h"
#include "shape/measure.h"
#include "shape/topology/half_edges.h"

namespace rholm {
namespace {

// Returns the corner of a half-edge's triangle that is not on the edge.
std::uint32_t opposite_corner(const Mesh& mesh, const HalfEdge& half_edge) {
  return mesh.faces[half_edge.triangle()][(half_edge.corner() + 2) % 3];
}

// Counts triangles that repeat an earlier one, at the edge of their two smaller vertices.
std::size_t count_duplicates(const Mesh& mesh, std::span<const HalfEdge> group) {
  std::vector<std::uint32_t> largest;
  for (const HalfEdge& half_edge : group) {
    const std::uint32_t third = opposite_corner(mesh, half_edge);
    if (third > half_edge.larger()) largest.push_back(third);
  }
  std::sort(largest.begin(), largest.end());
  const auto distinct = std::unique(largest.begin(), largest.end()) - largest.begin();
  return largest.size() - static_cast<std::size_t>(distinct);
}

// The two corners of a half-edge's triangle at the smaller and the larger vertex of the edge.
struct CornersOnEdge {
  std::uint32_t smaller;
  std::uint32_t larger;
};
CornersOnEdge corners_on_edge(const HalfEdge& half_edge) {
  const std::uint32_t start = half_edge.corner();
  const std::uint32_t end = start % 3 == 2 ? start - 2 : start + 1;
  return half_edge.rises() ? CornersOnEdge{start, end} : CornersOnEdge{end, start};
}

// Counts edges of each kind. Corners of neighbouring triangles at the same vertex are joined: the
// resulting sets are the fans of the vertices.
void inspect_edges(const Mesh& mesh, Inspection& result) {
  const HalfEdges half_edges = sort_half_edges(mesh.vertices.size(), mesh.faces);
  DisjointSets fans(3 * mesh.faces.size());
  DisjointSets parts(mesh.faces.size());
  std::vector<std::uint32_t> fans_at(mesh.vertices.size(), 0);
  half_edges.for_each_edge([&](std::uint32_t smaller, std::span<const HalfEdge> group) {
    ++result.edges;
    if (group.size() == 1) {
      ++result.boundary_edges;
      return;
    }
    if (group.size() == 2) {
      result.misoriented_edges += group[0].rises() == group[1].rises();
    } else {
      ++result.non_manifold_edges;
      fans_at[smaller] = fans_at[group[0].larger()] = 2;  // not a single fan in any case
    }
    const CornersOnEdge first = corners_on_edge(group[0]);
    for (const HalfEdge& half_edge : group.subspan(1)) {
      const CornersOnEdge next = corners_on_edge(half_edge);
      fans.unite(first.smaller, next.smaller);
      fans.unite(first.larger, next.larger);
      parts.unite(group[0].triangle(), half_edge.triangle());
    }
    result.duplicate_faces += count_duplicates(mesh, group);
  });
  CancelPoll poll;
  for (std::uint32_t t = 0; t < mesh.faces.size(); ++t) {
    poll();
    if (has_repeated_corner(mesh.faces[t])) continue;
    result.components += parts.find(t) == t;
    for (std::uint32_t c = 3 * t; c < 3 * t + 3; ++c) {
      fans_at[mesh.faces[t][c - 3 * t]] += fans.find(c) == c;
    }
  }
  for (const std::uint32_t n : fans_at) {
    poll();
    result.isolated_vertices += n == 0;
    result.non_manifold_vertices += n > 1;
  }
}

void count_degenerate(const Mesh& mesh, double scale, Inspection& result) {
  const Vec3 error = scale * coordinate_error(view_of(mesh));
  CancelPoll poll;
  for (const Triangle& t : mesh.faces) {
    poll();
    result.degenerate_faces += is_thin(scaled_corners(mesh, t, scale), error);
  }
}

// Returns the mean of the vertices of triangles without a repeated corner.
Vec3 mean_of_used(const Mesh& mesh, const UnitFrame& frame) {
  std::vector<char> used(mesh.vertices.size(), 0);
  CancelPoll poll;
  for (const Triangle& t : mesh.faces) {
    poll();
    if (has_repeated_corner(t)) continue;
    for (const std::uint32_t v : t) used[v] = 1;
  }
  Vec3 sum;
  double n = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    poll();
    if (!used[v]) continue;
    sum += frame.to_local(mesh.vertices[v]);
    ++n;
  }
  return n > 0 ? frame.to_shape(sum / n) : Vec3{};
}

}  // namespace

Inspection inspect(const Mesh& mesh) {
  validate(mesh);
  Inspection result;
  result.vertices = mesh.vertices.size();
  result.faces = mesh.faces.size();
  inspect_edges(mesh, result);
  std::size_t faces = 0;
  CancelPoll poll;
  for (const Triangle& t : mesh.faces) {
    poll();
    faces += !has_repeated_corner(t);
  }
  result.euler_characteristic = static_cast<long long>(result.vertices - result.isolated_vertices) -
                                static_cast<long long>(result.edges) +
                                static_cast<long long>(faces);
  result.closed = faces > 0 && result.boundary_edges == 0;
  result.manifold = result.non_manifold_edges == 0 && result.non_manifold_vertices == 0;
  result.oriented = result.misoriented_edges == 0;
  // Euler's formula: each closed component has the characteristic 2 - 2 genus.
  const long long twice_genus =
      2 * static_cast<long long>(result.components) - result.euler_characteristic;
  if (result.closed && result.manifold) result.genus = static_cast<std::size_t>(twice_genus / 2);
  result.bounds = bounds(mesh.vertices);
  const UnitFrame frame = unit_frame(result.bounds);
  count_degenerate(mesh, frame.scale, result);
  const Measures measures = measure(view_of(mesh), frame);
  result.area = measures.area;
  result.volume = measures.volume;
  result.inside_out = result.closed && result.oriented && measures.volume < 0;
  result.vertex_centroid = mean_of_used(mesh, frame);
  result.volume_centroid = measures.volume_centroid;
  return result;
}

}  // namespace rholm
