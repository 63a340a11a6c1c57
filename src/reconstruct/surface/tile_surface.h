// The surface of the caps, tile by tile. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "parts/store.h"
#include "reconstruct/caps/tile_caps.h"
#include "reconstruct/field/tile_grid.h"
#include "reconstruct/field/tile_winding.h"
#include "reconstruct/points/tile_plan.h"
#include "reconstruct/surface/tile_mesh.h"
#include "rholm/context.h"
#include "surface/grid/block_grid.h"

namespace rholm {

// A block whose values are not those of the caps alone: holes are closed there.
struct ClosedBlock {
  BlockCoordinates at = {};
  std::array<float, BlockGrid::kNodes> values = {};
  std::array<std::uint64_t, 8> filled = {};  // as BlockGrid::filled
};

// The attribute that says how far vertices are within the data.
inline constexpr const char* kSupport = "support";
inline const std::vector<double>* support_of(const Mesh& mesh) {
  for (const Attribute& attribute : mesh.attributes) {
    if (attribute.name == kSupport) return &attribute.values;
  }
  return nullptr;
}

class TileSurface {
 public:
  TileSurface(PieceStore& store, const TilePlan& plan, const TileCaps& caps,
              const TileWinding& winding, const Vec3& origin);

  const GridFrame& frame() const { return frame_; }
  const TileCaps& caps() const { return caps_; }

  // The values of the grid: "grid/TILE", the blocks at the tile's border once more: "rim/TILE",
  // the places of those that have open cubes: "open/TILE", and all values of these blocks and of
  // those beside them: "near-open/TILE".
  void find_values(std::size_t tile, const Context& context);
  bool has_values(std::size_t tile) const { return has("rim", tile); }
  std::vector<BlockCoordinates> open(std::size_t tile) const;

  // The values of the caps at the tile's blocks of those coordinates, which are in order: read
  // where they are near open cubes, else found again.
  BlockGrid values_at(std::size_t tile, const std::vector<BlockCoordinates>& blocks,
                      const Context& context) const;
  // Once no value is asked for again.
  void forget_values(std::size_t tile) const;
  // All caps that reach some blocks.
  NearCaps caps_at(std::span<const BlockCoordinates> blocks) const;
  // The places of the tile's blocks, sorted.
  std::vector<BlockCoordinates> places(std::size_t tile) const;

  // Where holes are closed: "closed/TILE"; of all tiles, before any surface is extracted.
  void write_closed(std::size_t tile, std::span<const ClosedBlock> blocks);

  // The tile's part of the surface: "mesh/TILE". With `support`, an attribute of that name says
  // of all vertices how far they are within the data: data_support().
  TileMesh extract(std::size_t tile, bool support, const Context& context);
  TileMesh mesh(std::size_t tile) const;
  std::size_t n_own(std::size_t tile) const;
  std::uint64_t n_triangles(std::size_t tile) const;
  // Meshes written between these two come instead of those before, which are read until then:
  // "mesh-ROUND/TILE". The result if a run before has done it all: then nothing is to be written.
  std::optional<std::uint64_t> begin_round(const std::string& round);
  void end_round(std::uint64_t result);
  // The result of a round that has been ended, by this process or another; its meshes are read.
  std::uint64_t take_round(const std::string& round);
  void write_mesh(std::size_t tile, TileMesh& part);
  // A box that has all vertices of a tile's triangles.
  Bounds around(std::size_t tile) const;
  // One in which all triangles are the tile's.
  Bounds within(std::size_t tile) const;
  // Which vertices of which tiles these are.
  struct VertexOfTile {
    std::uint32_t tile = 0, vertex = 0;
    auto operator<=>(const VertexOfTile&) const = default;
  };
  std::vector<VertexOfTile> resolve(const std::vector<VertexKey>& keys) const;
  // All vertices of a tile's mesh, by the tiles they belong to.
  std::vector<VertexOfTile> names(std::size_t tile, const TileMesh& mesh) const;
  // Vertices of tiles first ... end - 1 that triangles of other tiles have.
  std::vector<VertexOfTile> lent(std::size_t first, std::size_t end) const;
  // Only a part of a mesh.
  std::vector<TileMesh::Shared> shared(std::size_t tile) const;
  std::vector<VertexKey> foreign(std::size_t tile) const;
  std::uint32_t owner(const VertexKey& key) const {
    return key.is_direct() ? key.direct_tile() : frame_.owner({key.x, key.y, key.z});
  }

 private:
  bool has(const char* what, std::size_t tile) const;
  std::string mesh_name(std::size_t tile) const;  // of the last one
  NearCaps near_caps(std::size_t tile) const;
  // The values of the caps, of which all that reach the grid are given.
  void fill(const NearCaps& caps, BlockGrid& grid, const Context& context) const;
  void write_near_open(std::size_t tile, const BlockGrid& grid, std::size_t n_own,
                       std::span<const std::uint32_t> open) const;
  BlockGrid whole_grid(std::size_t tile, std::size_t& n_own, const Context& context) const;

  PieceStore& store_;
  const TilePlan& plan_;
  const TileCaps& caps_;
  const TileWinding& winding_;
  GridFrame frame_;
  std::vector<std::string> rounds_ = {};  // that are done
  std::string round_ = {};                // that is written
};

}  // namespace rholm
