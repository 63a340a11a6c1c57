// Rings of directions that are symmetric about the equator, in the layout of the kernels.
#pragma once

#include <cstddef>
#include <span>

#include "base/aligned_array.h"

namespace rholm {

// Arrays over rings are padded to a multiple of this number.
inline constexpr std::size_t kRingBlock = 32;
inline constexpr std::size_t kRingGroup = 8;  // a divisor of kRingBlock

// The northern half of symmetric rings: 0 <= theta <= pi/2. A ring on the equator is its own mirror
// image.
struct HalfRings {
  // Prefers sorted colatitudes: sums are fast if the rings of a block are near each other.
  explicit HalfRings(std::span<const double> north_colatitudes);

  std::size_t size = 0;    // number of northern rings
  std::size_t padded = 0;  // array lengths; entries beyond `size` repeat the last ring
  AlignedArray<double> cos_theta, sin_theta, cos2, sin2;
  // log2(sin theta) = log2_sin + log2_sin_rest. log2_sin has so few bits that its product with any
  // order is exact. At a pole it is a large negative number in place of minus infinity.
  AlignedArray<double> log2_sin, log2_sin_rest;
  AlignedArray<double> largest_sin;           // for every kRingGroup rings
  AlignedArray<double> least_sin, least_cos;  // for every kRingBlock rings
};

}  // namespace rholm
