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

// A block in which holes are closed: its values are not the values of the caps alone.
struct ClosedBlock {
  BlockCoordinates at = {};
  std::array<float, BlockGrid::kNodes> values = {};
  std::array<std::uint64_t, 8> filled = {};  // as BlockGrid::filled
};

// Name of the attribute that says how far vertices are within the data.
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

  // Finds the values of the grid, "grid/TILE", and again for blocks at the tile's border,
  // "rim/TILE". Writes the places of blocks with open cubes, "open/TILE". Writes all values of
  // these and of the blocks beside them, "near-open/TILE".
  void find_values(std::size_t tile, const Context& context);
  bool has_values(std::size_t tile) const { return has("rim", tile); }
  std::vector<BlockCoordinates> open(std::size_t tile) const;

  // Returns the values of the caps at some of the tile's blocks, which are in order. They are read
  // near open cubes, and computed again elsewhere.
  BlockGrid values_at(std::size_t tile, const std::vector<BlockCoordinates>& blocks,
                      const Context& context) const;
  // Removes the values that values_at() reads, once it is not called again.
  void forget_values(std::size_t tile) const;
  // Returns all caps that reach some blocks.
  NearCaps caps_at(std::span<const BlockCoordinates> blocks) const;
  // Returns the places of the tile's blocks, sorted.
  std::vector<BlockCoordinates> places(std::size_t tile) const;

  // Writes the blocks in which holes are closed: "closed/TILE". For all tiles before extract().
  void write_closed(std::size_t tile, std::span<const ClosedBlock> blocks);

  // Extracts the tile's part of the surface: "mesh/TILE". With `support`, an attribute of this name
  // says how far each vertex is within the data: data_support().
  TileMesh extract(std::size_t tile, bool support, const Context& context);
  TileMesh mesh(std::size_t tile) const;
  std::size_t n_own(std::size_t tile) const;
  std::uint64_t n_faces(std::size_t tile) const;
  // Meshes written between these two replace earlier ones, which are read until then:
  // "mesh-ROUND/TILE". Returns the result if a run before has done it all; then write nothing.
  std::optional<std::uint64_t> begin_round(const std::string& round);
  void end_round(std::uint64_t result);
  // Returns the result of a round that any process has ended; its meshes are read from here on.
  std::uint64_t take_round(const std::string& round);
  void write_mesh(std::size_t tile, TileMesh& part);
  // Returns a box that has all vertices of a tile's triangles.
  Bounds around(std::size_t tile) const;
  // Returns a box in which all triangles are the tile's.
  Bounds within(std::size_t tile) const;
  // Name of a vertex: its tile, and its number there.
  struct VertexOfTile {
    std::uint32_t tile = 0, vertex = 0;
    auto operator<=>(const VertexOfTile&) const = default;
  };
  std::vector<VertexOfTile> resolve(const std::vector<VertexKey>& keys) const;
  // Returns the names of all vertices of a tile's mesh, by the tiles that they belong to.
  std::vector<VertexOfTile> names(std::size_t tile, const TileMesh& mesh) const;
  // Returns the vertices of tiles first ... end - 1 that triangles of other tiles have.
  std::vector<VertexOfTile> lent(std::size_t first, std::size_t end) const;
  // These read only a part of a mesh.
  std::vector<TileMesh::Shared> shared(std::size_t tile) const;
  std::vector<VertexKey> foreign(std::size_t tile) const;
  std::uint32_t owner(const VertexKey& key) const {
    return key.is_direct() ? key.direct_tile() : frame_.owner({key.x, key.y, key.z});
  }

 private:
  bool has(const char* what, std::size_t tile) const;
  std::string mesh_name(std::size_t tile) const;  // of the last one
  NearCaps near_caps(std::size_t tile) const;
  // Fills the grid with the values of the caps; `caps` are all caps that reach it.
  void fill(const NearCaps& caps, BlockGrid& grid, const Context& context) const;
  void write_near_open(std::size_t tile, const BlockGrid& grid, std::size_t n_own,
                       std::span<const std::uint32_t> open) const;
  BlockGrid whole_grid(std::size_t tile, std::size_t& n_own, const Context& context) const;

  PieceStore& store_;
  const TilePlan& plan_;
  const TileCaps& caps_;
  const TileWinding& winding_;
  GridFrame frame_;
  std::vector<std::string> rounds_ = {};  // rounds that are done
  std::string round_ = {};                // round that is written
};

}  // namespace rholm
