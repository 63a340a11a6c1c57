#include "shape/topology/vertex_stars.h"
#include "base/cancel.h"

#include <algorithm>
#include <utility>

namespace rholm {
namespace {

using Link = std::vector<std::array<std::uint32_t, 2>>;

// Sorts the edges of a link so that each one begins where the last one ends, starting at a border
// if there is one. Returns false if this does not use all edges.
bool chain(Link& link, bool& open) {
  const auto has_end = [&](std::uint32_t v) {
    return std::any_of(link.begin(), link.end(), [&](const auto& edge) { return edge[1] == v; });
  };
  const auto first =
      std::find_if(link.begin(), link.end(), [&](const auto& edge) { return !has_end(edge[0]); });
  open = first != link.end();
  if (open) std::swap(*link.begin(), *first);
  for (auto at = link.begin(); at + 1 != link.end(); ++at) {
    const auto next =
        std::find_if(at + 1, link.end(), [&](const auto& edge) { return edge[0] == (*at)[1]; });
    if (next == link.end()) return false;
    std::swap(*(at + 1), *next);
  }
  return open || link.back()[1] == link.front()[0];
}

}  // namespace

VertexStars make_vertex_stars(std::size_t n_vertices, std::span<const Triangle> triangles) {
  VertexStars stars;
  stars.begin.assign(n_vertices + 1, 0);
  CancelPoll poll;
  for (const Triangle& t : triangles) {
    poll();
    for (const std::uint32_t v : t) ++stars.begin[v + 1];
  }
  for (std::size_t v = 0; v < n_vertices; ++v) stars.begin[v + 1] += stars.begin[v];
  stars.faces.resize(3 * triangles.size());
  // begin[v] moves to the end of the triangles of v, where the triangles of v + 1 begin.
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    poll();
    for (const std::uint32_t v : triangles[t]) stars.faces[stars.begin[v]++] = t;
  }
  for (std::size_t v = n_vertices; v > 0; --v) stars.begin[v] = stars.begin[v - 1];
  stars.begin[0] = 0;
  return stars;
}

void find_ring(std::span<const Triangle> triangles, const VertexStars& stars, std::uint32_t v,
               Ring& ring) {
  ring.kind = RingKind::kComplex;
  ring.neighbours.clear();
  ring.link.clear();
  for (const std::uint32_t t : stars.of(v)) {
    const Triangle& c = triangles[t];
    const std::size_t k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
    ring.link.push_back({c[(k + 1) % 3], c[(k + 2) % 3]});
  }
  bool open = false;
  if (ring.link.empty() || !chain(ring.link, open)) return;
  for (const auto& edge : ring.link) ring.neighbours.push_back(edge[0]);
  if (open) ring.neighbours.push_back(ring.link.back()[1]);
  // A neighbour occurs twice where two fans touch, or at the end of an edge of three triangles.
  for (auto at = ring.neighbours.begin(); at != ring.neighbours.end(); ++at) {
    if (std::find(ring.neighbours.begin(), at, *at) != at) return;
  }
  const bool flat = !open && ring.neighbours.size() < 3;  // two triangles back to back
  if (!flat) ring.kind = open ? RingKind::kOpen : RingKind::kClosed;
}

}  // namespace rholm
