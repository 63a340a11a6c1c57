// Triangles between directions: their Delaunay triangulation on the sphere. Layer: chart.
#pragma once

#include <span>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

struct DelaunayOptions {
  // A triangle at the border goes if its longest edge is longer than this many spacings; then its
  // neighbours stand at the border. The spacing of a point is its third shortest edge, that of a
  // triangle the middle one of its corners'. Infinity keeps the convex hull on the sphere.
  double gap = 3;
};

// The triangles, counter-clockwise seen from outside, each with its smallest index first, in
// ascending order. Directions are seen from the origin and have any length above 0; points of the
// same direction (to about 1e-14), but for one, belong to no triangle. Directions within an open
// hemisphere leave the rest of the sphere uncovered; others are covered whole, but for what `gap`
// takes away. Fewer than three directions, and those on one great circle, have no triangles.
// Throws InvalidInput for directions that are zero or not finite.
std::vector<Triangle> sphere_delaunay(std::span<const Vec3> directions,
                                      const DelaunayOptions& options = {});

}  // namespace rholm
