// The zero level of a block grid as a triangle mesh (marching cubes; method 7.9).
#pragma once

#include <cstdint>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "surface/grid/block_grid.h"

namespace rholm {

struct ExtractedSurface {
  // Triangles counter-clockwise from outside (where values are positive). One vertex per crossed
  // grid edge: vertices of edges that start in block b are first_vertex[b] ... first_vertex[b + 1].
  Mesh mesh;
  std::vector<std::uint32_t> first_vertex;  // n_blocks + 1
  // Per vertex, whether an end of its edge is a filled node; empty if the grid has none.
  std::vector<std::uint8_t> filled;
};

// Cubes with an unknown corner get no triangle. If no cube with both signs has one, the mesh is a
// closed 2-manifold, else it has borders there (and may touch itself in a vertex). Vertices are
// placed by linear interpolation. Throws Unsupported if there are more than 2^31 / 3 triangles.
ExtractedSurface extract_surface(const BlockGrid& grid, const Context& context = {});

}  // namespace rholm
