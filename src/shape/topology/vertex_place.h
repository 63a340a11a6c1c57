// Hashes points by the bits of their coordinates, so that identical vertices can be found.
#pragma once

#include <bit>
#include <cstdint>

#include "rholm/vec3.h"

namespace rholm {

// Applies one round of the finaliser of splitmix64 (Steele, Lea, Flood 2014).
inline std::uint64_t mix_bits(std::uint64_t h) {
  h ^= h >> 31;
  h *= 0xBF58476D1CE4E5B9U;
  return h ^ (h >> 29);
}

// Returns a hash of the coordinates; 0 and -0 have the same hash.
inline std::uint64_t place_hash(const Vec3& v) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
  return mix_bits(mix_bits(mix_bits(bits(v.x)) + bits(v.y)) + 3 * bits(v.z));
}

}  // namespace rholm
