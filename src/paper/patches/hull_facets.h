// Convex hulls of points, by Qhull (hull_qhull.cpp); a build without it refuses them
// (hull_none.cpp). Layer: paper, private.
#pragma once

#include <span>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Returns the triangles of the hull of points x, y, z, x, y, z ..., with any orientation; none if
// the points are in a plane. Throws InvalidInput if Qhull fails, Unsupported without it.
std::vector<Triangle> hull_facets(std::span<double> coordinates);

}  // namespace rholm
