// A surface cut open along a loop, and both sides closed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Vertices in the order of a loop, and the corners (3 t + k) of triangles that are on its right
// side there, each with its vertex's place in the loop.
struct LoopSides {
  std::vector<std::uint32_t> vertices;
  std::vector<std::pair<std::size_t, std::uint32_t>> right;
};

// Of half-edges that each begin where the one before ends, over inner vertices, none twice.
LoopSides sides_of(const std::vector<std::uint32_t>& loop, const std::vector<Triangle>& triangles,
                   const std::vector<std::uint32_t>& mates);

// Both sides get a fan of triangles around the loop's middle: where it bounds no part of the
// surface, one handle is gone. Appends to the mesh, with the attributes of the loop's vertices, a
// copy of each of those for the right side, and two middles with the attributes of the first;
// appends to `copies` the vertices that they are copies of.
void cut_along(const LoopSides& loop, Mesh& mesh, std::vector<std::uint32_t>& copies);

}  // namespace rholm
