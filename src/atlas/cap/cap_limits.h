// Bounds for evaluating and fitting caps, in any precision. Layer: atlas.
#pragma once

#include <cstddef>

namespace rholm {

// Number of doubles in the widest vectors; arrays are padded to a multiple of it.
inline constexpr std::size_t kCapLanes = 8;
constexpr std::size_t padded(std::size_t n) { return (n + kCapLanes - 1) / kCapLanes * kCapLanes; }
// Least n . u of a usable point, 84 degrees off the ray; steeper points determine only slopes.
inline constexpr double kLeastFacing = 0.1;
// Least cosine of a usable point's angle to the axis: 154 degrees. Chosen: the plane
// ends at 180 degrees, and there it is four times as wide as for a hemisphere.
inline constexpr double kLowest = -0.9;

// A cap has a potential where the cosine to its axis and r / R_0 are at least these bounds.
inline constexpr double kLeastAhead = 0.3;
inline constexpr double kLeastLevel = 0.2;

// Sums of weights up to this bound count as zero: 1e-5 of a cap's own weight.
inline constexpr double kLeastWeight = 1e-5;

}  // namespace rholm
