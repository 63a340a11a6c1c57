// Rings of directions that lie symmetric about the equator, as the kernels want them.
#pragma once

#include <cstddef>
#include <span>

#include "base/aligned_array.h"

namespace rholm {

// Arrays over rings are padded to a multiple of this.
inline constexpr std::size_t kRingBlock = 32;
inline constexpr std::size_t kRingGroup = 8;  // divides it

// The northern half of symmetric rings: 0 <= theta <= pi/2. An equator ring is its own mirror
// image.
struct HalfRings {
  // Best ascending or descending: sums are fast where the rings of a block are near each other.
  explicit HalfRings(std::span<const double> north_colatitudes);

  std::size_t size = 0;    // rings of the northern half
  std::size_t padded = 0;  // array lengths; what is beyond `size` repeats the last ring
  AlignedArray<double> cos_theta, sin_theta, cos2, sin2;
  // log2(sin theta) = log2_sin + log2_sin_rest; the first has so few bits that its product with
  // any order is exact. At a pole a number that stands for minus infinity.
  AlignedArray<double> log2_sin, log2_sin_rest;
  AlignedArray<double> largest_sin;           // of every kRingGroup rings
  AlignedArray<double> least_sin, least_cos;  // of every kRingBlock rings
};

}  // namespace rholm
