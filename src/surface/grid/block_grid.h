// Grid of values that exists only near a surface: blocks of 8 x 8 x 8 nodes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/aligned_array.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

using BlockCoordinates = std::array<std::int32_t, 3>;  // x, y, z
inline constexpr std::int32_t kNoBlock = -1;

// Node (i, j, k) of block b, 0 <= i, j, k < 8, is at origin + step (8 b +
// (i, j, k)). A node whose value is not finite is unknown. Unknown is a
// quiet NaN, not a large number: arithmetic on it shows in the result, while
// a large number gives a plausible vertex. (So -ffast-math is not allowed.)
struct BlockGrid {
  static constexpr int kSide = 8;
  static constexpr std::size_t kNodes = 512;
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

  Vec3 origin;
  double step = 1;
  // Distinct. Blocks from list_blocks() are sorted
  // by z, y, x; blocks added later follow them.
  std::vector<BlockCoordinates> blocks;
  // 512 values per block, x fastest, with room for further blocks: the
  // signed distance, positive outside, or kUnknown. Zero counts as outside.
  AlignedArray<float> values;
  // One bit per node in the order of the values, 8 words per block; empty while all bits
  // are 0. A bit is set where the value is a guess, not measured (see close_grid.h).
  std::vector<std::uint64_t> filled;
  // Block at b + (dx, dy, dz), or kNoBlock, at index (dx+1) + 3 (dy+1) + 9 (dz+1).
  std::vector<std::array<std::int32_t, 27>> neighbours;
  std::vector<std::int32_t> slots;  // hash table of find_block()

  std::size_t n_blocks() const { return blocks.size(); }
  float* block_values(std::size_t block) { return values.data() + block * kNodes; }
  const float* block_values(std::size_t block) const { return values.data() + block * kNodes; }
  Vec3 node(std::size_t block, int i, int j, int k) const {
    const BlockCoordinates& b = blocks[block];
    return origin + step * Vec3{8.0 * b[0] + i, 8.0 * b[1] + j, 8.0 * b[2] + k};
  }
  Vec3 node(std::size_t block, std::size_t index) const {
    const auto n = static_cast<int>(index);
    return node(block, n & 7, (n >> 3) & 7, n >> 6);
  }
  bool is_filled(std::size_t block, std::size_t index) const {
    return !filled.empty() && ((filled[8 * block + (index >> 6)] >> (index & 63)) & 1) != 0;
  }
};

// Block coordinates must lie in +-kBlockLimit; 21 bits each make one key.
inline constexpr std::int32_t kBlockLimit = (1 << 20) - 2;

// Returns the index of the block with these coordinates, or kNoBlock.
std::int32_t find_block(const BlockGrid& grid, const BlockCoordinates& coordinates);

// Part of a slab within a ball: |x - center| <= radius and |normal
// . (x - center)| <= half_thickness. The normal has length 1.
struct Disc {
  Vec3 center;
  Vec3 normal;
  double radius = 0;
  double half_thickness = 0;
};

// Returns the blocks (sorted by z, y, x) near a disc: all with a node in it,
// and some others. Throws OutOfMemory above `max_blocks`, each 8 bytes here
// and 2.5 KiB in a grid. Throws InvalidInput if a disc is beyond kBlockLimit.
std::vector<BlockCoordinates> list_blocks(const Vec3& origin, double step,
                                          std::span<const Disc> discs, std::size_t max_blocks,
                                          const Context& context = {});

// Makes a grid of these blocks with unknown values. `blocks` must be distinct.
BlockGrid make_block_grid(const Vec3& origin, double step, std::vector<BlockCoordinates> blocks,
                          const Context& context = {});

// Appends the blocks that the grid lacks (checked), with unknown values.
void add_blocks(BlockGrid& grid, std::span<const BlockCoordinates> blocks);

// Returns the bytes of a grid of n blocks: values, coordinates, neighbours, hash table.
std::size_t block_grid_bytes(std::size_t n_blocks);

}  // namespace rholm
