// Holes of a closed grid: connected sets of filled nodes. Layer: surface.
#pragma once

#include <cstdint>
#include <vector>

#include "rholm/vec3.h"
#include "surface/grid/block_grid.h"

namespace rholm {

struct NodeId {
  std::uint32_t block = 0;
  std::uint16_t node = 0;
};

struct Hole {
  std::vector<NodeId> nodes;  // all nodes in the grid's order
  std::vector<NodeId> rim;    // nodes of the hole next to a measured node
  Vec3 center;                // mean of the rim
  double radius = 0;          // mean distance of the rim from `center`
  double reach = 0;           // largest distance of a node from `center`
};

// Counts the connected parts of the surface beside a hole: 1 for a hole in one sheet. It counts
// connected sets of measured nodes next to rim and surface, outside and inside separately. The
// larger count is returned: between two close sheets, nodes of one sign touch both.
std::size_t count_borders(const BlockGrid& grid, const Hole& hole);

// Finds the holes, ordered by first node. Filled nodes connect to the 26 nodes around them.
std::vector<Hole> find_holes(const BlockGrid& grid);

// Finds the node at `node` + (dx, dy, dz), each -1, 0 or 1; false if its block is missing.
bool step_to(const BlockGrid& grid, const NodeId& node, int dx, int dy, int dz, NodeId& result);

}  // namespace rholm
