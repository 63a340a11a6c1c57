// Signs of the nodes of a block as bit masks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rholm {

// Bit x + 8 y of word z belongs to node (x, y, z).
using NodeBits = std::array<std::uint64_t, 8>;

struct NodeMasks {
  NodeBits known = {};   // finite
  NodeBits inside = {};  // finite and below zero: zero of either sign is outside
};

// Of blocks that stand one behind the other, 512 values each.
void node_masks(const float* values, std::size_t n_blocks, NodeMasks* masks);

// Shifts within a slice: bit (x, y) of the result is bit (x + 1, y) of `bits`, column 8 being
// column 0 of `next`; and so on.
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
