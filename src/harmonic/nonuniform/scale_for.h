// The scale of numbers in single precision.
#pragma once

#include <algorithm>
#include <cmath>

namespace rholm {

// A power of two that brings numbers of this size to 1 ... 2: single precision ends at 1e38, and
// nothing is rounded by it.
inline double scale_for(double largest) {
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  return std::exp2(std::min(1023, -std::ilogb(largest)));
}

}  // namespace rholm
