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

// Returns the number of the tile that contains a place. Tiles fill space.
using TileOf = std::function<std::uint32_t(const Vec3&)>;

// Position of a grid in space: its node (0, 0, 0), and the distance to the next node.
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

// Returns true if `a` comes before `b` in the order of list_blocks().
bool comes_before(const BlockCoordinates& a, const BlockCoordinates& b);
BlockCoordinates beside(const BlockCoordinates& block, int direction);  // 0 ... 26, 13 is itself

// The blocks that belong to a tile, and the other blocks beside one of them.
struct OwnBlocks {
  std::vector<BlockCoordinates> own, around;  // sorted
};
OwnBlocks own_blocks(const GridFrame& frame, std::uint32_t tile,
                     std::span<const BlockCoordinates> blocks, const Context& context = {});

// Returns the indices of a tile's own blocks that have a neighbour place in another tile.
std::vector<std::uint32_t> border_blocks(const GridFrame& frame, std::uint32_t tile,
                                         std::span<const BlockCoordinates> own,
                                         const Context& context = {});

}  // namespace rholm
