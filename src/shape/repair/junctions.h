// Vertices of one face that lie on an edge of another (T-junctions), joined to it. Layer: shape.
#pragma once

#include <cstddef>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

struct Junctions {
  std::size_t thin = 0;    // triangles dropped: a corner lies on the edge of the others
  std::size_t joined = 0;  // triangles split, each at one vertex; new ones come last
};

// Drops triangles without width beside edges that are not of two triangles, then those beside edges
// that this has opened. Then it joins open edges that leave one vertex in one direction: the
// triangle of the longer one is split at the end of the shorter one, which closes the shorter one,
// and so on along the edge. The surface stays within `error`, which is coordinate_error() in the
// unit of the vertices. No triangle may have a repeated corner.
Junctions join_junctions(const std::vector<Vec3>& vertices, const Vec3& error,
                         std::vector<Triangle>& triangles);

}  // namespace rholm
