// The half-edges of a mesh in pairs. Half-edge 3 t + k runs from corner k of triangle t to the
// next. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

inline std::uint32_t next_corner(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
inline std::uint32_t previous_corner(std::uint32_t c) { return c % 3 == 0 ? c + 2 : c - 1; }

// Where half-edge c begins, and where it ends.
inline std::uint32_t start_of(const std::vector<Triangle>& triangles, std::uint32_t c) {
  return triangles[c / 3][c % 3];
}
inline std::uint32_t end_of(const std::vector<Triangle>& triangles, std::uint32_t c) {
  return start_of(triangles, next_corner(c));
}

inline constexpr std::uint32_t kNoMate = ~std::uint32_t{0};

// For each half-edge that of the triangle beyond its edge, kNoMate along a border. Where two
// triangles meet they are mates, whatever their senses; edges of more have none. Throws as
// sort_half_edges().
std::vector<std::uint32_t> find_mates(std::size_t n_vertices,
                                      const std::vector<Triangle>& triangles);

// Of triangles that are oriented alike: a half-edge that begins at each vertex; kNoMate at those of
// borders, and where not all triangles of the vertex are around it in one fan.
std::vector<std::uint32_t> inner_outgoing(std::size_t n_vertices,
                                          const std::vector<Triangle>& triangles,
                                          const std::vector<std::uint32_t>& mates);

// Calls visit(c) for the half-edges that begin at an inner vertex, counter-clockwise from `first`.
template <typename Visit>
void for_each_outgoing(const std::vector<std::uint32_t>& mates, std::uint32_t first, Visit visit) {
  std::uint32_t c = first;
  do {
    visit(c);
    c = mates[previous_corner(c)];
  } while (c != first);
}

}  // namespace rholm
