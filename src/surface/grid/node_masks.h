// Bit masks of the signs of a block's nodes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rholm {

// Bit x + 8 y of word z belongs to node (x, y, z).
using NodeBits = std::array<std::uint64_t, 8>;

struct NodeMasks {
  NodeBits known = {};   // finite values
  NodeBits inside = {};  // finite values below zero: both zeros count as outside
};

// Computes the masks of consecutive blocks of 512 values each.
void node_masks(const float* values, std::size_t n_blocks, NodeMasks* masks);

// Shifts within a slice: bit (x, y) of from_next_x() is bit (x + 1, y) of `bits`, where
// column 8 is column 0 of `next`. The other three functions shift along the other directions.
inline constexpr std::uint64_t kFirstColumn = 0x0101010101010101ULL;
inline std::uint64_t from_next_x(std::uint64_t bits, std::uint64_t next) {
  return ((bits >> 1) & ~(kFirstColumn << 7)) | ((next & kFirstColumn) << 7);
}
inline std::uint64_t from_next_y(std::uint64_t bits, std::uint64_t next) {
  return bits >> 8 | next << 56;
}
inline std::uint64_t from_last_x(std::uint64_t bits, std::uint64_t last) {
  return ((bits << 1) & ~kFirstColumn) | ((last >> 7) & kFirstColumn);
}
inline std::uint64_t from_last_y(std::uint64_t bits, std::uint64_t last) {
  return bits << 8 | last >> 56;
}

}  // namespace rholm
