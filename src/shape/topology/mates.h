// Pairs the half-edges of a mesh. Half-edge 3 t + k runs from corner k of triangle t to the
// next corner. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

inline std::uint32_t next_corner(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
inline std::uint32_t previous_corner(std::uint32_t c) { return c % 3 == 0 ? c + 2 : c - 1; }

// Return the vertex at which half-edge c begins, and the vertex at which it ends.
inline std::uint32_t start_of(const std::vector<Triangle>& triangles, std::uint32_t c) {
  return triangles[c / 3][c % 3];
}
inline std::uint32_t end_of(const std::vector<Triangle>& triangles, std::uint32_t c) {
  return start_of(triangles, next_corner(c));
}

inline constexpr std::uint32_t kNoMate = ~std::uint32_t{0};

// Returns for each half-edge the other half-edge of its edge, or kNoMate along a border. The
// half-edges of two triangles are mates even if they run in the same direction. Edges of three or
// more triangles have no mates. Throws as sort_half_edges().
std::vector<std::uint32_t> find_mates(std::size_t n_vertices,
                                      const std::vector<Triangle>& triangles);

// Returns for each inner vertex a half-edge that begins there; kNoMate for vertices of borders or
// with several fans. The triangles must be oriented alike.
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
