// The surface of a cap at its seed, where only orders 0 and 1 contribute. Layer: atlas.
#pragma once

#include <span>

#include "rholm/atlas.h"

namespace rholm {

struct CapPole {
  double level = 1;               // r / R_0
  double slope1 = 0, slope2 = 0;  // slope of log r along x and y, on the unopened sphere
};
CapPole cap_pole(const CapFrame& frame, CapBasis basis, int degree, std::span<const double> c);

// Point and unit normal of the surface at the seed.
struct CapFoot {
  Vec3 point;
  Vec3 normal;
};
CapFoot cap_foot(const Atlas& atlas, const Cap& cap);

}  // namespace rholm
