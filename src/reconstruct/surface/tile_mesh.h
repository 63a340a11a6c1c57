// The part of a surface that belongs to one tile: the triangles of the cubes that start in its
// blocks. Layer: reconstruct.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "surface/grid/block_grid.h"
#include "surface/level_set/extract.h"

namespace rholm {

// Key of a vertex of the whole surface: the block in which its edge starts, and the edge
// (ExtractedSurface::edges).
struct VertexKey {
  std::int32_t z = 0, y = 0, x = 0;
  std::uint32_t edge = 0;

  // Names a vertex by its number in its tile, also if it is not on an edge.
  static VertexKey direct(std::uint32_t tile, std::uint32_t vertex) {
    return {.z = static_cast<std::int32_t>(tile), .y = 0, .x = 0, .edge = kDirect | vertex};
  }
  bool is_direct() const { return (edge & kDirect) != 0; }
  std::uint32_t direct_tile() const { return static_cast<std::uint32_t>(z); }
  std::uint32_t direct_vertex() const { return edge & ~kDirect; }
  static constexpr std::uint32_t kDirect = std::uint32_t{1} << 31;

  auto operator<=>(const VertexKey&) const = default;
};

struct TileMesh {
  // The tile's own vertices, whose edges start in its blocks, come first. Then come vertices of
  // other tiles that its triangles have. All have the attributes nx, ny, nz.
  Mesh mesh;
  std::size_t n_own = 0;
  std::vector<std::uint8_t> filled;  // as ExtractedSurface::filled
  std::vector<VertexKey> foreign;    // the vertices behind its own, ascending

  // Own vertices in the blocks at the tile's border, which triangles of other tiles may have.
  struct Shared {
    VertexKey key;
    std::uint32_t vertex = 0;
  };
  std::vector<Shared> shared;  // sorted by key
};

// Makes it from the result of extract_part() for the first `n_own` blocks, with projected vertices.
// `border` lists the blocks among them that are at the border of the tile.
TileMesh tile_mesh(ExtractedSurface surface, const BlockGrid& grid, std::size_t n_own,
                   const std::vector<std::uint32_t>& border);

// Throws InvalidInput if the key is not there.
const TileMesh::Shared* find_shared(const std::vector<TileMesh::Shared>& shared,
                                    const VertexKey& key);

}  // namespace rholm
