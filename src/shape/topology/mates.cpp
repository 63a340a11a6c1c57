#include "shape/topology/mates.h"

#include "shape/topology/half_edges.h"

namespace rholm {
namespace {

// Returns the number of half-edges counter-clockwise around the start of `first`; 0 at a border.
std::size_t fan_size(const std::vector<std::uint32_t>& mates, std::uint32_t first) {
  std::size_t n = 0;
  for (std::uint32_t c = first; n == 0 || c != first; ++n) {
    c = mates[previous_corner(c)];
    if (c == kNoMate) return 0;
  }
  return n;
}

}  // namespace

std::vector<std::uint32_t> find_mates(std::size_t n_vertices,
                                      const std::vector<Triangle>& triangles) {
  const HalfEdges edges = sort_half_edges(n_vertices, triangles);
  std::vector<std::uint32_t> mates(3 * triangles.size(), kNoMate);
  edges.for_each_edge([&](std::uint32_t, std::span<const HalfEdge> edge) {
    if (edge.size() != 2) return;
    mates[edge[0].corner()] = edge[1].corner();
    mates[edge[1].corner()] = edge[0].corner();
  });
  return mates;
}

std::vector<std::uint32_t> inner_outgoing(std::size_t n_vertices,
                                          const std::vector<Triangle>& triangles,
                                          const std::vector<std::uint32_t>& mates) {
  std::vector<std::uint32_t> outgoing(n_vertices, kNoMate), count(n_vertices, 0);
  for (std::uint32_t c = 0; c < mates.size(); ++c) {
    const std::uint32_t v = start_of(triangles, c);
    outgoing[v] = c;
    ++count[v];
  }
  for (std::size_t v = 0; v < n_vertices; ++v) {
    if (count[v] > 0 && fan_size(mates, outgoing[v]) != count[v]) outgoing[v] = kNoMate;
  }
  return outgoing;
}

}  // namespace rholm
