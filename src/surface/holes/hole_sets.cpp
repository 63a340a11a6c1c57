#include "surface/holes/hole_sets.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/disjoint_sets.h"

namespace rholm {
namespace {

// Filled nodes in the grid's order, with the inverse mapping.
struct FilledNodes {
  std::vector<NodeId> nodes;
  std::vector<std::uint32_t> before;  // number of filled nodes before each word of grid.filled

  std::uint32_t index_of(const BlockGrid& grid, const NodeId& id) const {
    const std::size_t word = 8 * std::size_t{id.block} + (id.node >> 6);
    const std::uint64_t lower = (std::uint64_t{1} << (id.node & 63)) - 1;
    return before[word] + static_cast<std::uint32_t>(std::popcount(grid.filled[word] & lower));
  }
};

FilledNodes list_filled(const BlockGrid& grid) {
  FilledNodes list;
  list.before.resize(grid.filled.size());
  for (std::size_t word = 0; word < grid.filled.size(); ++word) {
    list.before[word] = static_cast<std::uint32_t>(list.nodes.size());
    std::uint64_t bits = grid.filled[word];
    for (; bits != 0; bits &= bits - 1) {
      list.nodes.push_back({static_cast<std::uint32_t>(word / 8),
                            static_cast<std::uint16_t>(64 * (word % 8) + std::countr_zero(bits))});
    }
  }
  return list;
}

// Calls visit(neighbour) for the 26 nodes around `id`.
template <typename Visit>
void for_each_neighbour(const BlockGrid& grid, const NodeId& id, Visit visit) {
  for (int n = 0; n < 27; ++n) {
    NodeId other;
    if (n != 13 && step_to(grid, id, n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1, other)) visit(other);
  }
}

bool touches_measured(const BlockGrid& grid, const NodeId& id) {
  bool touches = false;
  for_each_neighbour(grid, id, [&](const NodeId& other) {
    touches = touches || (!grid.is_filled(other.block, other.node) &&
                          std::isfinite(grid.block_values(other.block)[other.node]));
  });
  return touches;
}

bool is_measured(const BlockGrid& grid, const NodeId& id) {
  return !grid.is_filled(id.block, id.node) && std::isfinite(grid.block_values(id.block)[id.node]);
}

bool is_inside(const BlockGrid& grid, const NodeId& id) {
  return grid.block_values(id.block)[id.node] < 0;
}

// Returns true if a measured neighbour along an axis has the other sign.
bool touches_surface(const BlockGrid& grid, const NodeId& id) {
  for (int k = 0; k < 6; ++k) {
    const int d = k % 2 == 0 ? 1 : -1;
    NodeId other;
    if (step_to(grid, id, k / 2 == 0 ? d : 0, k / 2 == 1 ? d : 0, k / 2 == 2 ? d : 0, other) &&
        is_measured(grid, other) && is_inside(grid, other) != is_inside(grid, id)) {
      return true;
    }
  }
  return false;
}

std::uint64_t key_of(const NodeId& id) { return std::uint64_t{id.block} << 9 | id.node; }

// Counts the connected sets of nodes, given by their sorted keys.
std::size_t count_sets(const BlockGrid& grid, const std::vector<std::uint64_t>& keys) {
  DisjointSets sets(keys.size());
  std::size_t n = keys.size();
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    const NodeId id{static_cast<std::uint32_t>(keys[i] >> 9),
                    static_cast<std::uint16_t>(keys[i] & 511)};
    for_each_neighbour(grid, id, [&](const NodeId& other) {
      const auto at = std::lower_bound(keys.begin(), keys.end(), key_of(other));
      if (at == keys.end() || *at != key_of(other)) return;
      const auto j = static_cast<std::uint32_t>(at - keys.begin());
      if (sets.find(i) == sets.find(j)) return;
      sets.unite(i, j);
      --n;
    });
  }
  return n;
}

void measure(const BlockGrid& grid, Hole& hole) {
  if (hole.rim.empty()) return;
  const auto place = [&](const NodeId& id) { return grid.node(id.block, id.node); };
  for (const NodeId& id : hole.rim) hole.center += place(id) / static_cast<double>(hole.rim.size());
  for (const NodeId& id : hole.rim) {
    hole.radius += norm(place(id) - hole.center) / static_cast<double>(hole.rim.size());
  }
  for (const NodeId& id : hole.nodes) {
    hole.reach = std::max(hole.reach, norm(place(id) - hole.center));
  }
}

}  // namespace

bool step_to(const BlockGrid& grid, const NodeId& node, int dx, int dy, int dz, NodeId& result) {
  const int x = (node.node & 7) + dx;
  const int y = (node.node >> 3 & 7) + dy;
  const int z = (node.node >> 6) + dz;
  const auto side = [](int c) { return (c >> 3) + 1; };  // 0, 1, 2: below, within, above
  const std::int32_t block = grid.neighbours[node.block][side(x) + 3 * side(y) + 9 * side(z)];
  if (block == kNoBlock) return false;
  result.block = static_cast<std::uint32_t>(block);
  result.node = static_cast<std::uint16_t>((x & 7) + 8 * (y & 7) + 64 * (z & 7));
  return true;
}

std::size_t count_borders(const BlockGrid& grid, const Hole& hole) {
  std::vector<std::uint64_t> outside, inside;
  for (const NodeId& id : hole.rim) {
    for_each_neighbour(grid, id, [&](const NodeId& other) {
      if (!is_measured(grid, other) || !touches_surface(grid, other)) return;
      (is_inside(grid, other) ? inside : outside).push_back(key_of(other));
    });
  }
  std::size_t most = 0;
  for (std::vector<std::uint64_t>* keys : {&outside, &inside}) {
    std::sort(keys->begin(), keys->end());
    keys->erase(std::unique(keys->begin(), keys->end()), keys->end());
    most = std::max(most, count_sets(grid, *keys));
  }
  return most;
}

std::vector<Hole> find_holes(const BlockGrid& grid) {
  const FilledNodes filled = list_filled(grid);
  DisjointSets sets(filled.nodes.size());
  for (std::uint32_t i = 0; i < filled.nodes.size(); ++i) {
    for_each_neighbour(grid, filled.nodes[i], [&](const NodeId& other) {
      if (grid.is_filled(other.block, other.node)) sets.unite(i, filled.index_of(grid, other));
    });
  }
  std::vector<Hole> holes;
  std::vector<std::uint32_t> hole_of(filled.nodes.size());
  for (std::uint32_t i = 0; i < filled.nodes.size(); ++i) {
    const std::uint32_t first = sets.find(i);  // smallest index of the set
    if (first == i) {
      hole_of[i] = static_cast<std::uint32_t>(holes.size());
      holes.emplace_back();
    }
    Hole& hole = holes[hole_of[first]];
    hole.nodes.push_back(filled.nodes[i]);
    if (touches_measured(grid, filled.nodes[i])) hole.rim.push_back(filled.nodes[i]);
  }
  for (Hole& hole : holes) measure(grid, hole);
  return holes;
}

}  // namespace rholm
