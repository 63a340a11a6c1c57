// Computes random numbers of points from their coordinates. Points chosen by them are the same in
// any order and any tiles. Layer: shape.
#pragma once

#include <bit>
#include <cstdint>

#include "base/random.h"
#include "rholm/vec3.h"

namespace rholm {

inline std::uint64_t rank_of(const Vec3& p) {
  std::uint64_t bits = 0;
  for (const double x : {p.x, p.y, p.z}) bits = random_bits(bits, std::bit_cast<std::uint64_t>(x));
  return bits;
}

// Returns true if the point of this rank is among the chosen share of all points.
inline bool is_chosen(std::uint64_t rank, double share) {
  return static_cast<double>(rank >> 11) * 0x1p-53 < share;
}

}  // namespace rholm
