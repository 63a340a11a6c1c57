// The cone of a triangle as it is seen from a centre.
#pragma once

#include <array>
#include <cstddef>

#include "chart/center/local_view.h"

namespace rholm {

// Corners of a triangle relative to a centre in the shape's coordinates.
inline std::array<Vec3, 3> corners_from(const LocalView& view, std::size_t triangle,
                                        const Vec3& center) {
  std::array<Vec3, 3> corners = view.corners(triangle);
  for (Vec3& corner : corners) corner -= view.frame.scale * center;
  return corners;
}

// Of a triangle that turns its front: 1 if the direction lies inside its cone, 0 if outside, -1 if
// rounding hides it. Of one that turns its back the same of the opposite direction.
inline int cone_contains(const std::array<Vec3, 3>& corners, const Vec3& direction) {
  bool unclear = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& a = corners[k];
    const Vec3& b = corners[k == 2 ? 0 : k + 1];
    const double side = dot(cross(a, b), direction);
    // Six products of three factors: below 8 2^-53 of the lengths.
    const double rounding = 8 * 0x1p-53 * norm(a) * norm(b);
    if (side < -rounding) return 0;
    unclear = unclear || side <= rounding;
  }
  return unclear ? -1 : 1;
}

}  // namespace rholm
