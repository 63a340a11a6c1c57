// Faces thinner than the rounding of their coordinates, taken out of a mesh by swaps of edges that
// keep the surface within the rounding. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// A thin face has a corner on its longest edge: that edge is swapped for the one from this corner
// to the corner beyond. `error` as from coordinate_error(), in the unit of the vertices; `mates` as
// find_mates() gives them, and follows the triangles. Mates that run in one sense, and swaps that
// would make an edge a second time or fold the surface, are left out. Thin faces whose longest edge
// has no mate are marked in `gone`, one flag a triangle, or stay where that is null. Returns how
// many thin faces have become others or are marked.
std::size_t swap_thin_faces(const std::vector<Vec3>& vertices, const Vec3& error,
                            std::vector<Triangle>& triangles, std::vector<std::uint32_t>& mates,
                            std::vector<char>* gone = nullptr);

// The same by the mesh's own coordinate_error() and find_mates(); nothing is dropped.
std::size_t swap_thin_faces(Mesh& mesh);

}  // namespace rholm
