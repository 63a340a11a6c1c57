// A part of the surface of all tiles as one mesh, and given back changed. Layer: reconstruct,
// private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "reconstruct/surface/tile_surface.h"
#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

class GatheredPart {
 public:
  static constexpr std::uint32_t kNew = ~std::uint32_t{0};
  // One flag per triangle of a tile's mesh.
  using Choose = std::function<std::vector<std::uint8_t>(std::size_t tile, const TileMesh& mesh)>;
  using ChooseTile = std::function<bool(std::size_t tile)>;

  // The chosen triangles of tiles first ... end - 1.
  GatheredPart(TileSurface& surface, std::size_t first, std::size_t end, const Choose& choose);
  // The chosen triangles of some tiles; there is no rim().
  GatheredPart(TileSurface& surface, std::size_t n_tiles, const ChooseTile& choose_tile,
               const Choose& choose);

  // With all attributes of tiles' meshes. Vertices by tiles and places there, triangles by
  // tiles.
  const Mesh& mesh() const { return mesh_; }
  // Per vertex, whether a triangle that is not gathered has it, or may have it.
  const std::vector<std::uint8_t>& rim() const { return rim_; }
  std::uint32_t tile_of_triangle(std::size_t t) const { return triangles_[t].tile; }
  // Which vertex of which tile.
  const TileSurface::VertexOfTile& name(std::size_t v) const { return names_[v]; }
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  // The gathered vertex of that name, or kNone.
  std::uint32_t find(const TileSurface::VertexOfTile& name) const;

  // What comes instead of the gathered triangles: a mesh, which of the gathered vertices each
  // vertex is, kNew for new ones, and the tile of each triangle. Those of the rim must be there as
  // long as others have them, and stay as they are.
  struct Changed {
    Mesh mesh;
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint32_t> tiles;
    bool new_are_filled = false;  // see TileMesh::filled
  };
  // `drop`, if given, tells which of the triangles that are not gathered go: one flag per triangle
  // of the tile. Only tiles that change are written.
  void replace(const Changed& changed, const Choose& drop = {});

 private:
  struct TriangleOfTile {
    std::uint32_t tile = 0, triangle = 0;
  };
  struct Corner {
    TileSurface::VertexOfTile name;
    std::uint32_t vertex = 0;  // of the changed mesh
  };
  struct NewTriangles;
  struct Left;

  void gather(const ChooseTile& choose_tile, const Choose& choose, Left* left);
  // Of each tile, whether what was gathered of it is not as it was.
  std::vector<std::uint8_t> changed_tiles(const Changed& changed) const;
  void find_rim(const std::vector<std::vector<bool>>& left_own,
                const std::vector<TileSurface::VertexOfTile>& left_foreign);
  std::uint32_t index_of(const TileSurface::VertexOfTile& name) const;
  void rewrite(std::size_t tile, const Changed& changed, const NewTriangles& fresh,
               const std::vector<std::uint8_t>& dropped);

  TileSurface& surface_;
  std::size_t first_, end_;
  Mesh mesh_;
  std::vector<TileSurface::VertexOfTile> names_;  // ascending
  std::vector<std::uint8_t> rim_;
  std::vector<TriangleOfTile> triangles_;
};

}  // namespace rholm
