// Removes faces thinner than the rounding of their coordinates by swaps of edges, which keep the
// surface within the rounding. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Swaps the longest edge of a thin face, which has a corner on it. The new edge runs from
// this corner to the corner beyond. `error`: coordinate_error() in the unit of the vertices.
// `mates`: from find_mates(); updated. Mates in the same direction, and swaps that duplicate
// an edge or fold the surface, are left out. Thin faces whose longest edge has no mate are
// marked in `gone`, one flag per triangle; they stay if it is null. Returns the number of
// thin faces changed or marked.
std::size_t swap_thin_faces(const std::vector<Vec3>& vertices, const Vec3& error,
                            std::vector<Triangle>& triangles, std::vector<std::uint32_t>& mates,
                            std::vector<char>* gone = nullptr);

// Uses the mesh's own coordinate_error() and find_mates(); drops no face.
std::size_t swap_thin_faces(Mesh& mesh);

}  // namespace rholm
