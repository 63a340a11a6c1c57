// A part of the surface of all tiles, gathered as one mesh and given back changed. Layer:
// reconstruct, private.
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

  // Gathers the chosen triangles of tiles first ... end - 1.
  GatheredPart(TileSurface& surface, std::size_t first, std::size_t end, const Choose& choose);
  // Gathers the chosen triangles of some tiles; then there is no rim().
  GatheredPart(TileSurface& surface, std::size_t n_tiles, const ChooseTile& choose_tile,
               const Choose& choose);

  // Returns the mesh with all attributes of tiles' meshes. Vertices are in the order of tiles and
  // of their numbers there, triangles in the order of tiles.
  const Mesh& mesh() const { return mesh_; }
  // Returns 1 for each vertex that a triangle outside of the gathered part has, or may have.
  const std::vector<std::uint8_t>& rim() const { return rim_; }
  std::uint32_t tile_of_triangle(std::size_t t) const { return triangles_[t].tile; }
  // Returns the tile of a vertex, and its number there.
  const TileSurface::VertexOfTile& name(std::size_t v) const { return names_[v]; }
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  // Returns the gathered vertex with this name, or kNone.
  std::uint32_t find(const TileSurface::VertexOfTile& name) const;

  // Replacement of the gathered triangles: a mesh, the gathered vertex that each vertex is, kNew
  // for new ones, and the tile of each triangle. Vertices of the rim stay unchanged, and must be
  // there as long as other triangles have them.
  struct Changed {
    Mesh mesh;
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint32_t> tiles;
    bool new_are_filled = false;  // see TileMesh::filled
  };
  // `drop`, if given, returns one flag per triangle of a tile: 1 to remove a triangle that is not
  // gathered. Only tiles that change are written.
  void replace(const Changed& changed, const Choose& drop = {});

 private:
  struct TriangleOfTile {
    std::uint32_t tile = 0, triangle = 0;
  };
  struct Corner {
    TileSurface::VertexOfTile name;
    std::uint32_t vertex = 0;  // vertex of the changed mesh
  };
  struct NewTriangles;
  struct Left;

  void gather(const ChooseTile& choose_tile, const Choose& choose, Left* left);
  // Returns 1 for each tile whose gathered part has changed.
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
