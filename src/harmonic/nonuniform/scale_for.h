// The scale of numbers in single precision.
#pragma once

#include <algorithm>
#include <cmath>

namespace rholm {

// Returns the power of two that brings numbers of this size to 1 ... 2. Single precision ends at
// 1e38; a power of two rounds nothing.
inline double scale_for(double largest) {
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  return std::exp2(std::min(1023, -std::ilogb(largest)));
}

}  // namespace rholm
