// Recognises points that span no surface.
#pragma once

#include <algorithm>
#include <span>

#include "rholm/vec3.h"

namespace rholm {

// Returns true if all points lie within `width` of the line from the first point to the point
// farthest from it. O(n); true for no points. Squares of the coordinates must not overflow.
inline bool lie_on_line(std::span<const Vec3> points, double width) {
  if (points.empty()) return true;
  const Vec3 first = points.front();
  const auto distance = [&](const Vec3& p) { return norm(p - first); };
  const Vec3 far =
      *std::max_element(points.begin(), points.end(),
                        [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
  const Vec3 along = normalized(far - first);
  return std::all_of(points.begin(), points.end(),
                     [&](const Vec3& p) { return norm(cross(p - first, along)) <= width; });
}

}  // namespace rholm
