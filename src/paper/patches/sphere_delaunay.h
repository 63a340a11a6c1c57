// Triangles between directions: their Delaunay triangulation on the sphere. Layer: chart.
#pragma once

#include <span>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

struct DelaunayOptions {
  // A triangle at the border is removed if its longest edge exceeds this number of spacings; its
  // neighbours are then at the border. The spacing of a point is its third shortest edge, of a
  // triangle the middle value of its corners. Infinity keeps the convex hull on the sphere.
  double gap = 3;
};

// Returns the triangles in ascending order, counter-clockwise seen from outside, each with its
// smallest index first. Directions are seen from the origin and have any length above 0. Triangles
// use only one of the points with the same direction (to about 1e-14). Directions within an open
// hemisphere cover a part of the sphere; others cover it all, except for what `gap` removes. Fewer
// than three directions, and directions on one great circle, have no triangles. Throws InvalidInput
// for directions that are zero or not finite.
std::vector<Triangle> sphere_delaunay(std::span<const Vec3> directions,
                                      const DelaunayOptions& options = {});

}  // namespace rholm
