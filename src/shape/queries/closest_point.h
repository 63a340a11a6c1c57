// Computes the closest point of a triangle to a given point, safe for degenerate triangles.
#pragma once

#include <array>

#include "rholm/vec3.h"

namespace rholm {

// Needs corners and point of order 1, because it forms squares of squares. For a triangle without
// area it returns the closest point of its edges; no input causes a division by zero. The error of
// the distance |p - result| is a few roundings of the largest coordinate. For a sliver with
// smallest angle alpha it is at most 2^-52 / alpha times the distance.
Vec3 closest_point_of_triangle(const Vec3& p, const std::array<Vec3, 3>& corners);

// Returns the point of the segment from a to b that is closest to p.
Vec3 closest_point_of_segment(const Vec3& p, const Vec3& a, const Vec3& b);

}  // namespace rholm
