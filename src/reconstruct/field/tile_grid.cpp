#include "reconstruct/field/tile_grid.h"

#include <algorithm>

#include "base/indices_where.h"

namespace rholm {

bool comes_before(const BlockCoordinates& a, const BlockCoordinates& b) {
  if (a[2] != b[2]) return a[2] < b[2];
  return a[1] != b[1] ? a[1] < b[1] : a[0] < b[0];
}

BlockCoordinates beside(const BlockCoordinates& block, int direction) {
  return {block[0] + direction % 3 - 1, block[1] + direction / 3 % 3 - 1,
          block[2] + direction / 9 - 1};
}

OwnBlocks own_blocks(const GridFrame& frame, std::uint32_t tile,
                     std::span<const BlockCoordinates> blocks, const Context& context) {
  const auto n = static_cast<std::uint32_t>(blocks.size());
  const std::vector<std::uint32_t> own =
      indices_where(n, context, [&](std::uint32_t b) { return frame.owner(blocks[b]) == tile; });
  std::vector<std::uint8_t> is_own(n, 0);
  for (const std::uint32_t b : own) is_own[b] = 1;
  OwnBlocks result;
  result.own.reserve(own.size());
  for (const std::uint32_t b : own) result.own.push_back(blocks[b]);
  const auto touches_own = [&](std::uint32_t b) {
    if (is_own[b] != 0) return false;
    for (int direction = 0; direction < 27; ++direction) {
      const BlockCoordinates other = beside(blocks[b], direction);
      if (std::binary_search(result.own.begin(), result.own.end(), other, comes_before))
        return true;
    }
    return false;
  };
  for (const std::uint32_t b : indices_where(n, context, touches_own)) {
    result.around.push_back(blocks[b]);
  }
  return result;
}

std::vector<std::uint32_t> border_blocks(const GridFrame& frame, std::uint32_t tile,
                                         std::span<const BlockCoordinates> own,
                                         const Context& context) {
  return indices_where(own.size(), context, [&](std::uint32_t b) {
    // Tiles are convex: the corners tell.
    for (const int direction : {0, 2, 6, 8, 18, 20, 24, 26}) {
      if (frame.owner(beside(own[b], direction)) != tile) return true;
    }
    return false;
  });
}

}  // namespace rholm
