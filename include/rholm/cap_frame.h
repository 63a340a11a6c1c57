// Frame of a cap of an atlas: its sphere, and the dilation of the sphere. Layer: chart.
#pragma once

#include "rholm/vec3.h"

namespace rholm {

// x, y, z are orthonormal and right-handed; z points outwards.
struct CapFrame {
  Vec3 center;          // centre of the sphere
  Vec3 x, y, z;         // axes of the local frame
  double radius = 1;    // R_0 > 0; the seed is center + radius z
  double dilation = 1;  // a >= 1: tan(theta'/2) = a tan(theta/2)
  double support = 0;   // radius of the cap's points around the seed
  // Returns the point of the sphere in the centre of the cap.
  Vec3 seed() const { return center + radius * z; }
};

}  // namespace rholm
