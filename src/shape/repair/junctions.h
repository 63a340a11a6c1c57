// Joins vertices of one face that lie on an edge of another (T-junctions) to it. Layer: shape.
#pragma once

#include <cstddef>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

struct Junctions {
  std::size_t thin = 0;    // number of triangles dropped: a corner is on the opposite edge
  std::size_t joined = 0;  // number of triangles split, each at one vertex; new ones come last
};

// Drops triangles without width at edges that do not have two triangles, also at edges that become
// such. Then it joins open edges that leave a vertex in the same direction. The triangle of the
// longer edge is split at the end of the shorter one, which closes the latter, and so on along the
// edge. The surface stays within `error`, coordinate_error() in the vertices' unit. No triangle
// may have a repeated corner.
Junctions join_junctions(const std::vector<Vec3>& vertices, const Vec3& error,
                         std::vector<Triangle>& triangles);

}  // namespace rholm
