// What the kernels of cap_fit.cpp and their callers share: included once per target.
#pragma once

#include <cstddef>

namespace rholm {

inline constexpr std::size_t kCapLanes =
    8;  // doubles of the widest vectors; arrays are padded to it
// n . u of a point that can be fitted: 84 degrees off the ray; steeper, slopes are all one sees.
inline constexpr double kLeastFacing = 0.1;

// Where a cap has a potential: cosine of the angle to its axis, and r / R_0, no less than these (as
// the kernels of the grid have it).
inline constexpr double kLeastAhead = 0.3;
inline constexpr double kLeastLevel = 0.2;

}  // namespace rholm
