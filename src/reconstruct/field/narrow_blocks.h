// Blocks of a grid reduced to a quarter of their bytes: the sign of all nodes, and values only at
// both ends of the edges that the surface crosses. Layer: reconstruct.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "surface/grid/block_grid.h"

namespace rholm {

// Returns some blocks as bytes in the machine's order: coordinates, bits of known, inside and kept
// nodes, and the kept values. The blocks around them must be in the grid.
std::vector<std::byte> narrow_blocks(const BlockGrid& grid, std::span<const std::uint32_t> blocks,
                                     const Context& context = {});

// Values of a block. A value that is not kept becomes one step, with the sign of its node.
struct NarrowBlock {
  BlockCoordinates at = {};
  std::array<float, BlockGrid::kNodes> values;
};

// Calls visit(block) for each block. Throws InvalidInput for bytes not made by narrow_blocks().
void for_narrow_blocks(std::span<const std::byte> bytes, double step,
                       const std::function<void(const NarrowBlock&)>& visit);
// Returns only the coordinates of the blocks.
std::vector<BlockCoordinates> places_of_narrow(std::span<const std::byte> bytes);

}  // namespace rholm
