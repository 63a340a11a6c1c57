#include <optional>
#include <string>

#include <fmt/format.h>

#include "rholm/error.h"
#include "rholm/topology.h"
#include "shape/topology/half_edges.h"

namespace rholm {
namespace {

// Pairs the half-edges of one edge: the i-th rising one with the i-th falling one. Returns the
// number of half-edges without a partner.
std::size_t pair_group(std::uint32_t smaller, std::span<const HalfEdge> group,
                       std::vector<Edge>& edges) {
  const std::size_t n = group.size();
  if (n == 2 && group[0].rises() != group[1].rises()) {  // the usual case
    const std::size_t rising = group[1].rises();
    edges.push_back({.a = smaller,
                     .b = group[0].larger(),
                     .left = group[rising].triangle(),
                     .right = group[1 - rising].triangle()});
    return 0;
  }
  std::size_t rising = 0, falling = 0;
  while (true) {
    while (rising < n && !group[rising].rises()) ++rising;
    while (falling < n && group[falling].rises()) ++falling;
    if (rising == n || falling == n) break;
    edges.push_back({.a = smaller,
                     .b = group[0].larger(),
                     .left = group[rising++].triangle(),
                     .right = group[falling++].triangle()});
  }
  std::size_t alone = 0;
  for (; rising < n; ++rising) alone += group[rising].rises();
  for (; falling < n; ++falling) alone += !group[falling].rises();
  return alone;
}

struct Unpaired {
  std::size_t boundary = 0;     // edges with one half-edge
  std::size_t misoriented = 0;  // edges with two half-edges in the same direction
  std::size_t odd = 0;          // edges with three or more that do not pair
  std::size_t total() const { return boundary + misoriented + odd; }
};

// Returns advice on how to repair the mesh.
std::string advice(const Mesh& mesh, const Unpaired& unpaired) {
  const std::optional<double> tolerance =
      unpaired.boundary > 0 ? closing_tolerance(mesh) : std::nullopt;
  const std::string weld = tolerance ? fmt::format("--weld {:.2g}", *tolerance) : "";
  if (tolerance && unpaired.total() == unpaired.boundary) {
    return fmt::format("{} joins its borders, which lie within {:.2g} of each other", weld,
                       *tolerance);
  }
  return fmt::format("'rholm repair{}{}' orients faces alike and closes small holes",
                     tolerance ? " " : "", weld);
}

[[noreturn]] void throw_unpaired(const Mesh& mesh, const Unpaired& unpaired) {
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("the mesh is not closed and consistently oriented: {} edges have a side "
                          "without a partner ({} boundary edges, {} between faces of opposite "
                          "orientation, {} where three or more faces meet); {}",
                          unpaired.total(), unpaired.boundary, unpaired.misoriented, unpaired.odd,
                          advice(mesh, unpaired)));
}

}  // namespace

std::vector<Edge> pair_edges(const Mesh& mesh) {
  validate(mesh);
  const HalfEdges half_edges = sort_half_edges(mesh.vertices.size(), mesh.faces);
  std::vector<Edge> edges;
  edges.reserve(half_edges.sorted.size() / 2);
  Unpaired unpaired;
  half_edges.for_each_edge([&](std::uint32_t smaller, std::span<const HalfEdge> group) {
    if (pair_group(smaller, group, edges) == 0) return;
    if (group.size() == 1) {
      ++unpaired.boundary;
    } else if (group.size() == 2) {
      ++unpaired.misoriented;
    } else {
      ++unpaired.odd;
    }
  });
  if (unpaired.total() > 0) throw_unpaired(mesh, unpaired);
  return edges;
}

}  // namespace rholm
