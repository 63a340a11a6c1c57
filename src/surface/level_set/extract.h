// Extracts the zero level set of a block grid as a triangle mesh (marching cubes; method 7.9).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "surface/grid/block_grid.h"

namespace rholm {

struct ExtractedSurface {
  // Triangles are counter-clockwise from outside (where values are positive). Each crossed grid
  // edge has one vertex: edges from block b have first_vertex[b] ... first_vertex[b + 1] - 1.
  Mesh mesh;
  std::vector<std::uint32_t> first_vertex;  // n_blocks + 1
  // Per vertex, 1 if an end of its edge is a filled node; empty if the grid has none.
  std::vector<std::uint8_t> filled;
  // Per vertex, the first node of its edge, 0 ... 511, plus
  // 512 times the edge's axis; filled by extract_part() only.
  std::vector<std::uint16_t> edges;
};

// Reserves room for the copies of cut_handles.h. Without it, growing
// holds the mesh twice for a while; unused room costs no memory.
inline std::size_t room_for_copies(std::size_t n) { return n / 64 + 1024; }

// Makes no triangles in cubes with an unknown corner. If no cube of this kind has both signs, the
// mesh is a closed 2-manifold. Otherwise it has borders there, and may touch itself in a vertex.
// Vertices are interpolated linearly. Throws Unsupported above 2^31 / 3 triangles or vertices.
ExtractedSurface extract_surface(const BlockGrid& grid, const Context& context = {});
// Extracts the cubes of the first blocks only, as a part of the whole surface. All
// blocks around them must be there; vertices of edges in other blocks are included too.
ExtractedSurface extract_part(const BlockGrid& grid, std::size_t n_blocks,
                              const Context& context = {});
// Acts as extract_surface(), and frees the grid's values
// before it makes triangles, because both take as much memory.
ExtractedSurface extract_last_surface(BlockGrid& grid, const Context& context = {});

}  // namespace rholm
