// Computes positions along a Morton curve: close positions are usually close in space.
#pragma once

#include <algorithm>
#include <cstdint>

#include "rholm/vec3.h"

namespace rholm {

inline constexpr int kMortonLevels = 21;  // bits per axis

// Spreads the bits of v to every third bit.
inline std::uint64_t spread_bits(std::uint64_t v) {
  v = (v | v << 32) & 0x001f00000000ffffULL;
  v = (v | v << 16) & 0x001f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

// Returns the Morton code of a point in -1 ... 1; other points are moved to the border.
inline std::uint64_t morton(const Vec3& x) {
  const auto cell = [](double c) {
    const double scaled = (c + 1) * (1 << (kMortonLevels - 1));
    if (!(scaled > 0)) return std::uint64_t{0};
    return static_cast<std::uint64_t>(std::min(scaled, 0x1p21 - 1));
  };
  return spread_bits(cell(x.x)) | spread_bits(cell(x.y)) << 1 | spread_bits(cell(x.z)) << 2;
}

}  // namespace rholm
