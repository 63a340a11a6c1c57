// Holes of a mesh closed.
#pragma once

#include <cstddef>
#include <vector>

#include "rholm/mesh.h"
#include "rholm/repair.h"
#include "shape/repair/sheets.h"

namespace rholm {

// Closes what repair() says, and counts it: `mesh` manifold but for parts that are one-sided,
// coordinates of the order of 1. New vertices and triangles come last.
void close_holes(const Parts& parts, const std::vector<char>& one_sided,
                 const std::vector<std::uint32_t>& mates, std::size_t max_hole, Mesh& mesh,
                 RepairReport& report);

}  // namespace rholm
