#include "shape/topology/cut_graph.h"

#include <algorithm>
#include <cstddef>
#include <unordered_map>

#include "base/cancel.h"
#include "base/disjoint_sets.h"
#include "base/random.h"
#include "shape/topology/mates.h"

namespace rholm {
namespace {

constexpr std::uint32_t kRoot = ~std::uint32_t{0};
constexpr std::uint64_t kSeed = 1;  // an arbitrary seed

// Returns a spanning forest of the triangles: for each triangle the half-edge towards its root, or
// kRoot. The search is breadth first, so that paths are short. Borders, if any, are roots.
std::vector<std::uint32_t> triangle_forest(const std::vector<std::uint32_t>& mates) {
  const std::size_t n = mates.size() / 3;
  std::vector<std::uint32_t> up(n, kRoot), queue;
  std::vector<std::uint8_t> seen(n, 0);
  queue.reserve(n);
  std::size_t next = 0;
  const auto enter = [&](std::uint32_t t, std::uint32_t from) {
    if (seen[t] != 0) return;
    seen[t] = 1;
    up[t] = from;
    queue.push_back(t);
  };
  CancelPoll poll;
  const auto spread = [&] {
    for (; next < queue.size(); ++next) {
      poll();
      for (std::uint32_t c = 3 * queue[next]; c < 3 * queue[next] + 3; ++c) {
        if (mates[c] != kNoMate) enter(mates[c] / 3, mates[c]);
      }
    }
  };
  for (std::uint32_t c = 0; c < mates.size(); ++c) {
    if (mates[c] == kNoMate) enter(c / 3, c);
  }
  spread();
  for (std::uint32_t t = 0; t < n; ++t) {
    enter(t, kRoot);
    spread();
  }
  return up;
}

// Returns one half-edge of each edge that is in neither forest.
std::vector<std::uint32_t> edges_left(const Mesh& mesh, const std::vector<std::uint32_t>& mates,
                                      const std::vector<std::uint32_t>& up) {
  DisjointSets joined(mesh.vertices.size());
  std::vector<std::uint32_t> left;
  CancelPoll poll;
  for (std::uint32_t c = 0; c < mates.size(); ++c) {
    poll();
    const std::uint32_t back = mates[c];
    if (up[c / 3] == c || (back != kNoMate && (back < c || up[back / 3] == back))) continue;
    const std::uint32_t a = joined.find(start_of(mesh.faces, c));
    const std::uint32_t b = joined.find(end_of(mesh.faces, c));
    if (a == b) left.push_back(c);
    joined.unite(a, b);
  }
  return left;
}

}  // namespace

std::uint64_t CutGraph::crossed(std::uint32_t corner) const {
  const auto at =
      std::lower_bound(edges.begin(), edges.end(), corner,
                       [](const Edge& edge, std::uint32_t c) { return edge.corner < c; });
  return at != edges.end() && at->corner == corner ? at->crossed : 0;
}

CutGraph make_cut_graph(const Mesh& mesh, const std::vector<std::uint32_t>& mates) {
  const std::vector<std::uint32_t> up = triangle_forest(mates);
  std::unordered_map<std::uint32_t, std::uint64_t> crossed;  // by the edge's lower half-edge
  const auto cross_up_from = [&](std::uint32_t first, std::uint64_t bits) {
    for (std::uint32_t c = up[first / 3]; c != kRoot; c = up[mates[c] / 3]) {
      crossed[std::min(c, mates[c])] ^= bits;
      if (mates[c] == kNoMate) break;
    }
  };
  for (const std::uint32_t c : edges_left(mesh, mates, up)) {
    const std::uint64_t bits = random_bits(kSeed, c);
    crossed[c] ^= bits;
    // Crosses edges on both sides up to the roots. Edges common to both sides cancel.
    cross_up_from(c, bits);
    if (mates[c] != kNoMate) cross_up_from(mates[c], bits);
  }
  CutGraph graph;
  for (const auto& [c, bits] : crossed) {
    if (bits == 0) continue;
    graph.edges.push_back({c, bits});
    if (mates[c] != kNoMate) graph.edges.push_back({mates[c], bits});
    graph.vertices.push_back(start_of(mesh.faces, c));
    graph.vertices.push_back(end_of(mesh.faces, c));
  }
  std::sort(graph.edges.begin(), graph.edges.end(),
            [](const CutGraph::Edge& a, const CutGraph::Edge& b) { return a.corner < b.corner; });
  std::sort(graph.vertices.begin(), graph.vertices.end());
  graph.vertices.erase(std::unique(graph.vertices.begin(), graph.vertices.end()),
                       graph.vertices.end());
  graph.is_end.assign(mesh.vertices.size(), 0);
  for (const std::uint32_t v : graph.vertices) graph.is_end[v] = 1;
  return graph;
}

}  // namespace rholm
