// Which scans points are of. Layer: shape.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "rholm/points.h"

namespace rholm {

// Adds the values of the attribute `scan` of some points to those of others, ascending; false if
// they are no numbers of scans: no whole numbers, or more than kMaxScans different ones.
inline bool add_scans(std::span<const double> values, std::vector<double>& different) {
  for (const double value : values) {
    if (!(std::isfinite(value) && value == std::round(value))) return false;
    const auto at = std::lower_bound(different.begin(), different.end(), value);
    if (at != different.end() && *at == value) continue;
    if (different.size() == kMaxScans) return false;
    different.insert(at, value);
  }
  return true;
}

}  // namespace rholm
