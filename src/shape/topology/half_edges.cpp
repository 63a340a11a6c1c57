// Half-edges are sorted by counting of the smaller vertex, then each bucket is sorted. Buckets of a
// usual mesh hold about six half-edges, for which insertion sort is fastest.
#include "shape/topology/half_edges.h"

#include <algorithm>
#include <string>

#include "base/cancel.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Largest number of triangles: 3 t + k and the direction share 32 bits of a key.
constexpr std::size_t kMaxTriangles = (std::size_t{1} << 31) / 3;
// Chosen: larger buckets use std::sort, so that a vertex of n triangles costs n log n.
constexpr std::size_t kInsertionLimit = 24;

void sort_bucket(HalfEdge* first, HalfEdge* last) {
  if (last - first > static_cast<std::ptrdiff_t>(kInsertionLimit)) {
    std::sort(first, last);
    return;
  }
  for (HalfEdge* i = first + (first != last); i < last; ++i) {
    const HalfEdge moved = *i;
    HalfEdge* j = i;
    for (; j > first && moved < *(j - 1); --j) *j = *(j - 1);
    *j = moved;
  }
}

}  // namespace

HalfEdges sort_half_edges(std::size_t n_vertices, const std::vector<Triangle>& triangles) {
  if (triangles.size() > kMaxTriangles) {
    throw Error(ErrorCode::kUnsupported, "the mesh has " + std::to_string(triangles.size()) +
                                             " faces, more than the " +
                                             std::to_string(kMaxTriangles) +
                                             " whose edges can be numbered: decimate it first");
  }
  HalfEdges edges;
  std::vector<std::uint32_t>& begin = edges.begin;
  begin.assign(n_vertices + 2, 0);
  CancelPoll poll;
  for (const Triangle& t : triangles) {
    poll();
    if (has_repeated_corner(t)) continue;
    for (int k = 0; k < 3; ++k) ++begin[std::min(t[k], t[k == 2 ? 0 : k + 1]) + std::size_t{2}];
  }
  for (std::size_t v = 2; v < begin.size(); ++v) begin[v] += begin[v - 1];
  edges.sorted.resize(begin.back());
  // begin[v + 1] moves from the start of bucket v to its end, which is the start of bucket v + 1.
  std::uint32_t corner = 0;
  for (const Triangle& t : triangles) {
    poll();
    if (has_repeated_corner(t)) {
      corner += 3;
      continue;
    }
    for (int k = 0; k < 3; ++k, ++corner) {
      const std::uint32_t a = t[k], b = t[k == 2 ? 0 : k + 1];
      const std::uint64_t larger = std::max(a, b);
      edges.sorted[begin[std::min(a, b) + std::size_t{1}]++].key =
          larger << 32 | (corner << 1 | std::uint32_t{a > b});
    }
  }
  begin.pop_back();
  for (std::size_t v = 0; v < n_vertices; ++v) {
    poll();
    sort_bucket(edges.sorted.data() + begin[v], edges.sorted.data() + begin[v + 1]);
  }
  return edges;
}

}  // namespace rholm
