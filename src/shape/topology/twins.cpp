#include "shape/topology/twins.h"

#include "shape/topology/half_edges.h"

namespace rholm {
namespace {

// How many half-edges counter-clockwise from `first` until it comes again; 0 if a border does.
std::size_t fan_size(const std::vector<std::uint32_t>& twins, std::uint32_t first) {
  std::size_t n = 0;
  for (std::uint32_t c = first; n == 0 || c != first; ++n) {
    c = twins[previous_corner(c)];
    if (c == kNoTwin) return 0;
  }
  return n;
}

}  // namespace

std::vector<std::uint32_t> find_twins(std::size_t n_vertices,
                                      const std::vector<Triangle>& triangles) {
  const HalfEdges edges = sort_half_edges(n_vertices, triangles);
  std::vector<std::uint32_t> twins(3 * triangles.size(), kNoTwin);
  edges.for_each_edge([&](std::uint32_t, std::span<const HalfEdge> edge) {
    if (edge.size() != 2 || edge[0].rises() == edge[1].rises()) return;
    twins[edge[0].corner()] = edge[1].corner();
    twins[edge[1].corner()] = edge[0].corner();
  });
  return twins;
}

std::vector<std::uint32_t> inner_outgoing(std::size_t n_vertices,
                                          const std::vector<Triangle>& triangles,
                                          const std::vector<std::uint32_t>& twins) {
  std::vector<std::uint32_t> outgoing(n_vertices, kNoTwin), count(n_vertices, 0);
  for (std::uint32_t c = 0; c < twins.size(); ++c) {
    const std::uint32_t v = begin_of(triangles, c);
    outgoing[v] = c;
    ++count[v];
  }
  for (std::size_t v = 0; v < n_vertices; ++v) {
    if (count[v] > 0 && fan_size(twins, outgoing[v]) != count[v]) outgoing[v] = kNoTwin;
  }
  return outgoing;
}

}  // namespace rholm
