// Grids of blocks, filled from functions.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/grid/block_grid.h"

namespace rholm::test {

// Returns blocks low ... high - 1 along each axis, with all values unknown.
inline BlockGrid box_grid(const Vec3& origin, double step, int low, int high) {
  std::vector<BlockCoordinates> blocks;
  for (int z = low; z < high; ++z) {
    for (int y = low; y < high; ++y) {
      for (int x = low; x < high; ++x) blocks.push_back({x, y, z});
    }
  }
  return make_block_grid(origin, step, std::move(blocks));
}

// Sets all nodes to value(place of the node).
template <typename Value>
void fill_grid(BlockGrid& grid, const Value& value) {
  for (std::size_t b = 0; b < grid.n_blocks(); ++b) {
    for (std::size_t n = 0; n < BlockGrid::kNodes; ++n) {
      grid.block_values(b)[n] = static_cast<float>(value(grid.node(b, n)));
    }
  }
}

}  // namespace rholm::test
