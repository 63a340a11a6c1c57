// Which triangles go on into which: a mesh as sheets that are manifold by themselves, even where
// they touch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/mesh.h"
#include "shape/topology/mates.h"

namespace rholm {

// As find_mates(), also at edges of more than two triangles that are oriented alike: those that
// have the solid between them are mates (a falling half-edge and the next one around that rises),
// then what is left in pairs of neighbours; of an odd number one has none.
std::vector<std::uint32_t> find_mates_at_all_edges(const std::vector<Vec3>& vertices,
                                                   const std::vector<Triangle>& triangles);

// Parts of triangles connected through mates: part[t], counted in the order of their first ones.
struct Parts {
  std::vector<std::uint32_t> part;
  std::size_t n = 0;
};
Parts find_parts(std::size_t n_triangles, const std::vector<std::uint32_t>& mates);

struct Orienting {
  std::vector<char> flipped;    // per triangle
  std::vector<char> one_sided;  // per part: there is no orientation
};
// Turns triangles so that mates run through their edge in opposite senses: of each part the smaller
// share of its area. One-sided parts stay as they are. `mates` follows the triangles.
Orienting orient_alike(const std::vector<Vec3>& vertices, const Parts& parts,
                       std::vector<Triangle>& triangles, std::vector<std::uint32_t>& mates);

// Turns the triangles that are marked; `mates` follows.
void flip_marked(const std::vector<char>& marked, std::vector<Triangle>& triangles,
                 std::vector<std::uint32_t>& mates);

// Gives each fan of a vertex but the first a copy of it at the end of the list. Returns for each
// new vertex the one it is a copy of.
std::vector<std::uint32_t> separate_fans(std::size_t n_vertices,
                                         const std::vector<std::uint32_t>& mates,
                                         std::vector<Triangle>& triangles);

}  // namespace rholm
