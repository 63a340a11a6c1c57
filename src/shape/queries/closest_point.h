// The point of a triangle that is closest to a given point, safe for degenerate triangles.
#pragma once

#include <array>

#include "rholm/vec3.h"

namespace rholm {

// Corners and point should be of the order of 1 (squares of squares are formed). For a triangle
// without area the closest point of its three edges; no division by zero for any input. The error
// of the distance |p - result| is a few roundings of the largest coordinate; of a sliver with
// smallest angle alpha it is at most 2^-52 / alpha of the distance itself.
Vec3 closest_point_of_triangle(const Vec3& p, const std::array<Vec3, 3>& corners);

// The point of the segment from a to b that is closest to p.
Vec3 closest_point_of_segment(const Vec3& p, const Vec3& a, const Vec3& b);

}  // namespace rholm
