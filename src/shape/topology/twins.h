// The half-edges of a mesh in pairs. Corner c = 3 t + k stands for the half-edge of triangle t from
// its corner k to the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

inline std::uint32_t next_corner(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
inline std::uint32_t previous_corner(std::uint32_t c) { return c % 3 == 0 ? c + 2 : c - 1; }

// Where half-edge c begins, and where it ends.
inline std::uint32_t begin_of(const std::vector<Triangle>& triangles, std::uint32_t c) {
  return triangles[c / 3][c % 3];
}
inline std::uint32_t end_of(const std::vector<Triangle>& triangles, std::uint32_t c) {
  return begin_of(triangles, next_corner(c));
}

inline constexpr std::uint32_t kNoTwin = ~std::uint32_t{0};

// Of every half-edge the one back along the same edge; kNoTwin along borders, and unless exactly
// two of opposite senses share the edge. Throws as sort_half_edges().
std::vector<std::uint32_t> find_twins(std::size_t n_vertices,
                                      const std::vector<Triangle>& triangles);

// A half-edge that begins at each vertex; kNoTwin at those of borders, and where not all triangles
// of the vertex are around it in one fan.
std::vector<std::uint32_t> inner_outgoing(std::size_t n_vertices,
                                          const std::vector<Triangle>& triangles,
                                          const std::vector<std::uint32_t>& twins);

// Calls visit(c) for the half-edges that begin at an inner vertex, counter-clockwise from `first`.
template <typename Visit>
void for_each_outgoing(const std::vector<std::uint32_t>& twins, std::uint32_t first, Visit visit) {
  std::uint32_t c = first;
  do {
    visit(c);
    c = twins[previous_corner(c)];
  } while (c != first);
}

}  // namespace rholm
