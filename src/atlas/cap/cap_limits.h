// Bounds of what caps are asked for, in whatever precision. Layer: atlas.
#pragma once

#include <cstddef>

namespace rholm {

// Doubles of the widest vectors: arrays are padded to a multiple of it.
inline constexpr std::size_t kCapLanes = 8;
constexpr std::size_t padded(std::size_t n) { return (n + kCapLanes - 1) / kCapLanes * kCapLanes; }
// n . u of a point that can be fitted: 84 degrees off the ray; steeper, slopes are all one sees.
inline constexpr double kLeastFacing = 0.1;
// And the cosine of its angle to the axis: 154 degrees. Chosen: the plane ends at 180, and is four
// times as wide as a hemisphere's there.
inline constexpr double kLowest = -0.9;

// Where a cap has a potential: cosine of the angle to its axis, and r / R_0, no less than these.
inline constexpr double kLeastAhead = 0.3;
inline constexpr double kLeastLevel = 0.2;

// Sums of the caps' weights up to this count as none: a hundred thousandth of a cap's own.
inline constexpr double kLeastWeight = 1e-5;

}  // namespace rholm
