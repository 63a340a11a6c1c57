// The 256 cases of marching cubes: how the surface runs through a cube of eight nodes.
//
// Corner c of a cube is its node (c & 1, (c >> 1) & 1, c >> 2); a case has bit c set if corner c is
// inside. Edge e runs along axis e / 4 from corner kEdgeCorner[e] to that corner plus the axis.
#pragma once

#include <array>
#include <cstdint>

namespace rholm {

inline constexpr std::array<std::uint8_t, 12> kEdgeCorner = {0, 2, 4, 6, 0, 1, 4, 5, 0, 1, 2, 3};

// At most 12 edges are crossed; loops of n edges have n - 2 triangles, so 10 are enough.
struct SurfaceCase {
  std::uint8_t n_edges = 0;  // crossed
  std::uint8_t n_triangles = 0;
  std::array<std::uint8_t, 30> triangles = {};  // edges, counter-clockwise from outside
};

// Made once, by program, from these rules (method 7.9):
// - On each face of the cube, crossings are joined so that inside corners are kept apart where they
//   face each other diagonally. The rule sees the face only, so both cubes on it agree, and all
//   segments have a partner.
// - The segments form loops; a loop is cut into triangles by diagonals none of which has both ends
//   in one face of the cube. The neighbour cannot draw the same one, so no edge has four triangles.
// Hence the surface is closed and 2-manifold wherever all cubes with both signs are known.
const std::array<SurfaceCase, 256>& surface_table();

}  // namespace rholm
