// Holes of a mesh closed.
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
  std::vector<Triangle> triangles;  // indices of the rim
  double area = 0;
};

// Triangulates the closed polygon `rim`, its triangles running along it, without new vertices: of
// all triangulations the one whose largest angle between neighbours (also those beyond the rim:
// `beyond[i]` is the unit normal of the triangle at the edge from i to i + 1) is smallest, then the
// one of the least area (Barequet and Sharir 1995; Liepa 2003). O(n^3). A diagonal (i, j) must not
// be `taken`; none if that leaves no triangulation.
std::optional<HoleTriangles> triangulate_hole(
    std::span<const Vec3> rim, std::span<const Vec3> beyond,
    const std::function<bool(std::uint32_t, std::uint32_t)>& taken);

// Closes what repair() says, and counts it: `mesh` manifold but for parts that are one-sided,
// coordinates of the order of 1. New vertices and triangles come last.
void close_holes(const Parts& parts, const std::vector<char>& one_sided,
                 const std::vector<std::uint32_t>& mates, std::size_t max_hole, Mesh& mesh,
                 RepairReport& report);

}  // namespace rholm
