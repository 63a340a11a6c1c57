// The holes of a closed grid: connected sets of filled nodes. Layer: surface.
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
  std::vector<NodeId> nodes;  // in the grid's order
  std::vector<NodeId> rim;    // of those, the ones next to a measured node
  Vec3 center;                // mean of the rim
  double radius = 0;          // mean distance of the rim from it
  double reach = 0;           // largest distance of a node from it
};

// How many pieces the surface beside a hole has, by the measured nodes next to its rim that are
// next to the surface: the larger number of connected sets of those outside and of those inside,
// since between two sheets near each other one of these touches both. Of a hole in one sheet 1.
std::size_t count_borders(const BlockGrid& grid, const Hole& hole);

// Filled nodes are connected to the 26 around them. Ordered by the first node.
std::vector<Hole> find_holes(const BlockGrid& grid);

// The node at `node`'s place + (dx, dy, dz), each -1, 0 or 1; false if its block is missing.
bool step_to(const BlockGrid& grid, const NodeId& node, int dx, int dy, int dz, NodeId& result);

}  // namespace rholm
