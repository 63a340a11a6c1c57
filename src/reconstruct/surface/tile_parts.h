// Connected components of the surface of all tiles. Layer: reconstruct, private.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/ply/ply_parts.h"
#include "parts/store.h"
#include "reconstruct/surface/tile_surface.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "surface/level_set/components.h"

namespace rholm {

class TileParts {
 public:
  // `round` is part of the names of its pieces.
  TileParts(PieceStore& store, const TileSurface& surface, std::size_t n_tiles,
            std::string round = "");

  // Finds the components of a tile's triangles, and the components of the vertices that it shares
  // with other tiles: "parts/TILE".
  void find(std::size_t tile, const Context& context);
  bool has(std::size_t tile) const;

  // Components through all tiles, after find() of all of them. Components stay that
  // drop_small_components() would keep.
  struct Whole {
    std::size_t components = 0, dropped = 0;
    std::uint64_t vertices = 0, faces = 0;  // that stay
    Vec3 area_vector = {};
    double area = 0, closed_area = 0, volume = 0;  // that stay; closed_area: beside filled nodes
  };
  Whole join(double least_share);

  // Returns the part of a tile that stays, after join(): its own vertices, numbered from
  // `first_vertex` on in the whole, and its triangles by numbers in the whole. Vertices in no cap's
  // support have normals nx, ny, nz from their triangles.
  PlyPart part(std::size_t tile) const;
  // Returns the tile's mesh with these normals, and only the triangles that stay.
  TileMesh kept_mesh(std::size_t tile) const;

 private:
  struct Component {
    ComponentSize size;
    double guessed = 0;  // area
    std::uint64_t faces = 0;
  };
  struct Links {
    std::vector<std::uint32_t> shared, foreign;  // components, in the order of TileMesh's lists
    std::vector<Component> components;
    std::vector<std::uint64_t> vertices;  // number of own vertices of each component
  };
  // Part of a tile's triangles in the normal of another tile's vertex, which has none of its own.
  struct Lent {
    TileSurface::VertexOfTile vertex;
    Vec3 area_vector;
  };
  std::vector<Lent> lent_by(TileMesh& part) const;
  void complete_normals(std::size_t tile, TileMesh& part) const;
  Links links(std::size_t tile) const;
  std::vector<std::uint32_t> components_of_vertices(std::size_t tile) const;
  bool keeps_all(std::size_t tile) const;
  // Returns the numbers in the whole of some own vertices of a tile.
  std::vector<std::uint64_t> numbers(std::size_t tile,
                                     const std::vector<std::uint32_t>& vertices) const;
  // Returns one flag per own vertex.
  std::vector<std::uint8_t> kept_vertices(std::size_t tile) const;

  std::string name_of(const char* what, std::size_t tile) const;

  PieceStore& store_;
  const TileSurface& surface_;
  std::size_t n_tiles_;
  std::string round_;
  std::vector<std::vector<char>> stays_;  // of each tile's components
  std::vector<std::vector<std::uint32_t>>
      adopted_;                              // own vertices that only others' triangles have
  std::vector<std::vector<Lent>> borrowed_;  // of each tile's own vertices
  std::vector<std::uint64_t> n_vertices_;    // own ones of each tile
  // Numbers of the first ones of each tile in the whole, and the end.
  std::vector<std::uint64_t> first_vertex_, first_triangle_;
};

}  // namespace rholm
