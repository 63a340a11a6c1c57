// Division of polygons into triangles. Layer: shape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Appends the triangles of the polygon with these corners to `triangles`: n - 2 for n corners, none
// for fewer than three. Corners are indices below vertices.size(), in order around the polygon.
// Every triangle uses three corners and keeps the polygon's orientation.
//
// A quadrilateral is cut along the shorter of its inner diagonals, a convex polygon as a fan from
// its first corner. Other polygons are cut by ear clipping in the plane of the mean (Newell)
// normal. Clipping is impossible for a polygon that crosses itself, has no area, or is not convex
// with more than kMaxClippedCorners corners. It is cut as a fan, right or not.
void triangulate_polygon(const std::vector<Vec3>& vertices, std::span<const std::uint32_t> corners,
                         std::vector<Triangle>& triangles);

// Clipping takes O(n^2) steps, a few milliseconds for 1000 corners. The limit bounds the time per
// corner for any file.
inline constexpr std::size_t kMaxClippedCorners = 1000;

}  // namespace rholm
