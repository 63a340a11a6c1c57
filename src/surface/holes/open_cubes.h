// Cubes of nodes where the surface would end: with both signs and an unknown corner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/grid/block_grid.h"
#include "surface/grid/node_masks.h"

namespace rholm {

// What a block lacks for its open cubes: nodes of its own, and neighbours (bit as in
// BlockGrid::neighbours) that have a node that is asked for.
struct Wanted {
  NodeBits nodes = {};
  std::uint32_t neighbours = 0;
  bool any = false;
};

// Looks at the cubes with a corner in the block; `masks` are those of all blocks. Nodes of missing
// blocks are unknown.
Wanted find_wanted(const BlockGrid& grid, const std::vector<NodeMasks>& masks, std::size_t block);

}  // namespace rholm
