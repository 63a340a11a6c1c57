// Open cubes, where the surface would end: both signs and an unknown corner. Layer: surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/grid/block_grid.h"
#include "surface/grid/node_masks.h"

namespace rholm {

// Missing values of a block's open cubes: its own nodes, and missing
// neighbours (bits as in BlockGrid::neighbours) with a needed node.
struct Wanted {
  NodeBits nodes = {};
  std::uint32_t neighbours = 0;
  bool any = false;
};

// Searches the cubes with a corner in block b. `masks` are the
// masks of all blocks. Nodes of missing blocks are unknown.
Wanted find_wanted(const BlockGrid& grid, const std::vector<NodeMasks>& masks, std::size_t block);

}  // namespace rholm
