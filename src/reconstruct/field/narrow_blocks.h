// Blocks of a grid as their surface needs them: the sides of all nodes, and values only at both
// ends of the edges that it crosses. A quarter of the bytes. Layer: reconstruct.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "surface/grid/block_grid.h"

namespace rholm {

// Some of a grid's blocks as bytes, in the machine's order: coordinates, which nodes are known,
// which are inside, which values are kept, and these. The blocks around them must be in the grid.
std::vector<std::byte> narrow_blocks(const BlockGrid& grid, std::span<const std::uint32_t> blocks,
                                     const Context& context = {});

// Values of a block: those not kept are one step on their side.
struct NarrowBlock {
  BlockCoordinates at = {};
  std::array<float, BlockGrid::kNodes> values;
};

// Calls visit(block) for each. Throws InvalidInput for bytes that narrow_blocks() did not make.
void for_narrow_blocks(std::span<const std::byte> bytes, double step,
                       const std::function<void(const NarrowBlock&)>& visit);
// The coordinates alone.
std::vector<BlockCoordinates> places_of_narrow(std::span<const std::byte> bytes);

}  // namespace rholm
