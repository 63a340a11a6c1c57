// Which triangles of all tiles are connected, and what of them stays. Layer: reconstruct, private.
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
  // `round` is in the names of its pieces.
  TileParts(PieceStore& store, const TileSurface& surface, std::size_t n_tiles,
            std::string round = "");

  // The components of a tile's triangles, and which of them have the vertices that it shares with
  // others: "parts/TILE".
  void find(std::size_t tile, const Context& context);
  bool has(std::size_t tile) const;

  // Components through all tiles, once all are there. Those stay that drop_small_components()
  // would leave.
  struct Whole {
    std::size_t components = 0, dropped = 0;
    std::uint64_t vertices = 0, triangles = 0;  // that stay
    Vec3 area_vector = {};
    double area = 0, closed_area = 0, volume = 0;  // likewise; closed_area: beside filled nodes
  };
  Whole join(double least_share);

  // Of what stays, after join(): the tile's own vertices, which have the numbers from
  // `first_vertex` on in the whole, and its triangles by numbers in the whole.
  // Normals nx, ny, nz are in no cap's support those of the triangles.
  PlyPart part(std::size_t tile) const;
  // The tile's mesh with such normals, and only the triangles that stay.
  TileMesh kept_mesh(std::size_t tile) const;

 private:
  struct Component {
    ComponentSize size;
    double guessed = 0;  // area
    std::uint64_t triangles = 0;
  };
  struct Links {
    std::vector<std::uint32_t> shared, foreign;  // components, in the order of TileMesh's lists
    std::vector<Component> components;
    std::vector<std::uint64_t> vertices;  // own ones of each component
  };
  // What a tile's triangles add to the normal of another tile's vertex, which has none.
  struct Lent {
    TileSurface::VertexOfTile vertex;
    Vec3 area_vector;
  };
  std::vector<Lent> lent_by(TileMesh& part) const;
  void complete_normals(std::size_t tile, TileMesh& part) const;
  Links links(std::size_t tile) const;
  std::vector<std::uint32_t> components_of_vertices(std::size_t tile) const;
  bool keeps_all(std::size_t tile) const;
  // The numbers in the whole of some own vertices of a tile.
  std::vector<std::uint64_t> numbers(std::size_t tile,
                                     const std::vector<std::uint32_t>& vertices) const;
  // One flag per own vertex.
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
  // In the whole, of each tile, and the end.
  std::vector<std::uint64_t> first_vertex_, first_triangle_;
};

}  // namespace rholm
