// The 256 cases of marching cubes: the surface within a cube of eight nodes.
//
// Corner c of a cube is its node (c & 1, (c >> 1) & 1, c >> 2); a case has bit c set if corner c is
// inside. Edge e runs along axis e / 4 from corner kEdgeCorner[e] to that corner plus the axis.
#pragma once

#include <array>
#include <cstdint>

namespace rholm {

inline constexpr std::array<std::uint8_t, 12> kEdgeCorner = {0, 2, 4, 6, 0, 1, 4, 5, 0, 1, 2, 3};

// At most 12 edges are crossed; a loop of n edges has n - 2 triangles, so 10 suffice.
struct SurfaceCase {
  std::uint8_t n_edges = 0;  // number of crossed edges
  std::uint8_t n_faces = 0;
  std::array<std::uint8_t, 30> faces = {};  // edges, counter-clockwise from outside
};

// Returns the table, made once by these rules (method 7.9):
// - On each face of the cube, crossings are joined so that diagonally opposite inside
//   corners stay apart. The rule sees only the face. Both cubes on it therefore agree, and
//   all segments have a partner.
// - Segments form loops. Diagonals cut a loop into triangles, none with both ends in a face
//   of the cube. The neighbour cannot draw the same one, so no edge has four triangles.
// Hence the surface is closed and 2-manifold wherever all cubes with both signs are known.
const std::array<SurfaceCase, 256>& surface_table();

}  // namespace rholm
