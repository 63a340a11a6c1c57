// The blocks of a grid that belong to one tile of space. Layer: reconstruct.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "surface/grid/block_grid.h"

namespace rholm {

// The number of the tile that a place lies in: tiles fill space.
using TileOf = std::function<std::uint32_t(const Vec3&)>;

// A grid in space: where its node (0, 0, 0) is, and the way to the next.
struct GridFrame {
  Vec3 origin;
  double step = 1;
  TileOf tile_of;

  // A block belongs to the tile that its middle lies in.
  std::uint32_t owner(const BlockCoordinates& block) const {
    const Vec3 at{8.0 * block[0] + 3.5, 8.0 * block[1] + 3.5, 8.0 * block[2] + 3.5};
    return tile_of(origin + step * at);
  }
};

// In the order of list_blocks().
bool comes_before(const BlockCoordinates& a, const BlockCoordinates& b);
BlockCoordinates beside(const BlockCoordinates& block, int direction);  // 0 ... 26, 13 is itself

// Which of `blocks` (sorted) belong to a tile, and which of the others are beside one of those.
struct OwnBlocks {
  std::vector<BlockCoordinates> own, around;  // sorted
};
OwnBlocks own_blocks(const GridFrame& frame, std::uint32_t tile,
                     std::span<const BlockCoordinates> blocks, const Context& context = {});

// Those of a tile's own blocks (indices) that have a place beside them that belongs to another.
std::vector<std::uint32_t> border_blocks(const GridFrame& frame, std::uint32_t tile,
                                         std::span<const BlockCoordinates> own,
                                         const Context& context = {});

}  // namespace rholm
