// Closes holes of a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "rholm/mesh.h"
#include "rholm/repair.h"
#include "shape/repair/sheets.h"

namespace rholm {

struct HoleTriangles {
  std::vector<Triangle> faces;  // indices of rim vertices
  double area = 0;
};

// Triangulates the closed polygon `rim` without new vertices; triangles run along the rim.
// It minimises the largest angle between neighbours, then the area (Barequet and Sharir
// 1995; Liepa 2003). Neighbours beyond the rim count too: `beyond[i]` is the unit normal
// at the edge from i to i + 1. O(n^3). Returns nothing if every triangulation has a
// diagonal (i, j) that is `taken`.
std::optional<HoleTriangles> triangulate_hole(
    std::span<const Vec3> rim, std::span<const Vec3> beyond,
    const std::function<bool(std::uint32_t, std::uint32_t)>& taken);

// Closes holes as repair() describes, and counts them. `mesh` is manifold except in one-sided
// parts; its coordinates are of order 1. New vertices and triangles come last.
void close_holes(const Parts& parts, const std::vector<char>& one_sided,
                 const std::vector<std::uint32_t>& mates, std::size_t max_hole, Mesh& mesh,
                 RepairReport& report);

}  // namespace rholm
