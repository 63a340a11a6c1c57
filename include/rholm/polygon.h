// Polygons cut into triangles. Layer: shape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Appends the triangles of the polygon with these corners (indices below vertices.size(), in
// order around it) to `triangles`: n - 2 of them for n corners, none for fewer than three. The
// orientation of the polygon is kept and every triangle uses three of its corners.
//
// A quadrilateral is cut along the shorter of its diagonals that lie inside, a convex polygon
// as a fan from its first corner, any other by clipping ears in the plane of its mean (Newell)
// normal. Where that is not possible - the polygon crosses itself, has no area, or has more than
// kMaxClippedCorners corners and is not convex - it is a fan too, right or not.
void triangulate_polygon(const std::vector<Vec3>& vertices, std::span<const std::uint32_t> corners,
                         std::vector<Triangle>& triangles);

// Clipping takes O(n^2) steps, at 1000 corners a few milliseconds; the limit bounds the time per
// corner of a file whatever it holds.
inline constexpr std::size_t kMaxClippedCorners = 1000;

}  // namespace rholm
