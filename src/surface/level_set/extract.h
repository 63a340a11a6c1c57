// The zero level of a block grid as a triangle mesh (marching cubes; method 7.9).
#pragma once

#include <cstddef>
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
  // Per vertex, its edge: the node it starts at, 0 ... 511, + 512 times its axis; of a part of a
  // grid only.
  std::vector<std::uint16_t> edges;
};

// Room for what is cut (cut_handles.h): without it the mesh would be there twice for a while, and
// does not cost memory before it is used.
inline std::size_t room_for_copies(std::size_t n) { return n / 64 + 1024; }

// Cubes with an unknown corner get no triangle. If no cube with both signs has one, the mesh is a
// closed 2-manifold, else it has borders there (and may touch itself in a vertex). Vertices are
// placed by linear interpolation. Throws Unsupported if there are more than 2^31 / 3 triangles.
ExtractedSurface extract_surface(const BlockGrid& grid, const Context& context = {});
// Of the cubes of the first blocks only, as a part of the whole surface: with all vertices that
// start in these blocks, if all blocks around them are there, and those of others.
ExtractedSurface extract_part(const BlockGrid& grid, std::size_t n_blocks,
                              const Context& context = {});
// The same as the first, and frees the grid's values before there are triangles: both take as much
// memory.
ExtractedSurface extract_last_surface(BlockGrid& grid, const Context& context = {});

}  // namespace rholm
