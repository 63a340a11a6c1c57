// Splits a mesh into sheets that are manifold by themselves, even where they touch: it finds which
// triangles continue into which.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/mesh.h"
#include "shape/topology/mates.h"

namespace rholm {

// Does the same as find_mates(), but also pairs edges of more than two oriented triangles. Mates
// have the solid between them: a falling half-edge and the next rising one around the edge. The
// remaining half-edges are paired with neighbours; if their number is odd, one has no mate.
std::vector<std::uint32_t> find_mates_at_all_edges(const std::vector<Vec3>& vertices,
                                                   const std::vector<Triangle>& triangles);

// Parts of triangles connected through mates; part[t] is numbered in the order of first triangles.
struct Parts {
  std::vector<std::uint32_t> part;
  std::size_t n = 0;
};
Parts find_parts(std::size_t n_faces, const std::vector<std::uint32_t>& mates);

struct Orienting {
  std::vector<char> flipped;    // per triangle
  std::vector<char> one_sided;  // per part: true if it has no orientation
};
// Flips triangles so that mates run through their edge in opposite directions. In each part, the
// smaller area is flipped. One-sided parts stay unchanged. `mates` is updated.
Orienting orient_alike(const std::vector<Vec3>& vertices, const Parts& parts,
                       std::vector<Triangle>& triangles, std::vector<std::uint32_t>& mates);

// Flips the marked triangles and updates `mates`.
void flip_marked(const std::vector<char>& marked, std::vector<Triangle>& triangles,
                 std::vector<std::uint32_t>& mates);

// Gives each fan of a vertex, except the first, its own copy of the vertex at the end of the list.
// Returns for each new vertex the vertex that it is a copy of.
std::vector<std::uint32_t> separate_fans(std::size_t n_vertices,
                                         const std::vector<std::uint32_t>& mates,
                                         std::vector<Triangle>& triangles);

}  // namespace rholm
