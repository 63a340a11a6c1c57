// Describes the cone of a triangle seen from a centre.
#pragma once

#include <array>
#include <cstddef>

#include "chart/center/local_view.h"

namespace rholm {

// Returns a triangle's corners relative to a centre that is given in the shape's coordinates.
inline std::array<Vec3, 3> corners_from(const LocalView& view, std::size_t triangle,
                                        const Vec3& center) {
  std::array<Vec3, 3> corners = view.corners(triangle);
  for (Vec3& corner : corners) corner -= view.frame.scale * center;
  return corners;
}

// Returns 1 if the direction lies inside the cone of a front-facing triangle, 0 if outside, and -1
// if rounding hides the answer. For a back-facing triangle, pass the opposite direction.
inline int cone_contains(const std::array<Vec3, 3>& corners, const Vec3& direction) {
  bool unclear = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& a = corners[k];
    const Vec3& b = corners[k == 2 ? 0 : k + 1];
    const double side = dot(cross(a, b), direction);
    // Rounding of six products of three factors: below 8 2^-53 times the lengths.
    const double rounding = 8 * 0x1p-53 * norm(a) * norm(b);
    if (side < -rounding) return 0;
    unclear = unclear || side <= rounding;
  }
  return unclear ? -1 : 1;
}

}  // namespace rholm
