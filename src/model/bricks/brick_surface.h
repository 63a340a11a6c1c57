// The surface of the caps, brick by brick. Layer: model, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_caps.h"
#include "model/bricks/brick_plan.h"
#include "model/bricks/brick_winding.h"
#include "rholm/context.h"
#include "surface/bricks/brick_grid.h"
#include "surface/bricks/brick_mesh.h"
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

class BrickSurface {
 public:
  BrickSurface(PieceStore& store, const BrickPlan& plan, const BrickCaps& caps,
               const BrickWinding& winding, const Vec3& origin);

  const GridFrame& frame() const { return frame_; }
  const BrickCaps& caps() const { return caps_; }

  // The values of the grid: "grid/BRICK", the blocks at the brick's border once more: "rim/BRICK",
  // and the places of those that have open cubes: "open/BRICK".
  void find_values(std::size_t brick, const Context& context);
  bool has_values(std::size_t brick) const { return has("rim", brick); }
  std::vector<BlockCoordinates> open(std::size_t brick) const;

  // The values of the caps, of which all that reach the grid are given.
  void fill(const NearCaps& caps, BlockGrid& grid, const Context& context) const;
  // All caps that reach some blocks.
  NearCaps caps_at(std::span<const BlockCoordinates> blocks) const;
  // The places of the brick's blocks, sorted.
  std::vector<BlockCoordinates> places(std::size_t brick) const;

  // Where holes are closed: "closed/BRICK"; of all bricks, before any surface is extracted.
  void write_closed(std::size_t brick, std::span<const ClosedBlock> blocks);

  // The brick's part of the surface: "mesh/BRICK". With `support`, an attribute of that name says
  // of all vertices how far they are within the data: data_support().
  BrickMesh extract(std::size_t brick, bool support, const Context& context);
  BrickMesh mesh(std::size_t brick) const;
  std::size_t n_own(std::size_t brick) const;
  std::uint64_t n_triangles(std::size_t brick) const;
  // Meshes written between these two come instead of those before, which are read until then:
  // "mesh-ROUND/BRICK". The result if a run before has done it all: then nothing is to be written.
  std::optional<std::uint64_t> begin_round(const std::string& round);
  void end_round(std::uint64_t result);
  // The result of a round that has been ended, by this process or another; its meshes are read.
  std::uint64_t take_round(const std::string& round);
  void write_mesh(std::size_t brick, BrickMesh& part);
  // A box that has all vertices of a brick's triangles.
  Bounds around(std::size_t brick) const;
  // One in which all triangles are the brick's.
  Bounds within(std::size_t brick) const;
  // Which vertices of which bricks these are.
  struct VertexOfBrick {
    std::uint32_t brick = 0, vertex = 0;
    auto operator<=>(const VertexOfBrick&) const = default;
  };
  std::vector<VertexOfBrick> resolve(const std::vector<VertexKey>& keys) const;
  // All vertices of a brick's mesh, by the bricks they belong to.
  std::vector<VertexOfBrick> names(std::size_t brick, const BrickMesh& mesh) const;
  // Vertices of bricks first ... end - 1 that triangles of other bricks have.
  std::vector<VertexOfBrick> lent(std::size_t first, std::size_t end) const;
  // Only a part of a mesh.
  std::vector<BrickMesh::Shared> shared(std::size_t brick) const;
  std::vector<VertexKey> foreign(std::size_t brick) const;
  std::uint32_t owner(const VertexKey& key) const {
    return key.is_direct() ? key.direct_brick() : frame_.owner({key.x, key.y, key.z});
  }

 private:
  bool has(const char* what, std::size_t brick) const;
  std::string mesh_name(std::size_t brick) const;  // of the last one
  NearCaps near_caps(std::size_t brick) const;
  BlockGrid whole_grid(std::size_t brick, std::size_t& n_own, const Context& context) const;

  PieceStore& store_;
  const BrickPlan& plan_;
  const BrickCaps& caps_;
  const BrickWinding& winding_;
  GridFrame frame_;
  std::vector<std::string> rounds_ = {};  // that are done
  std::string round_ = {};                // that is written
};

}  // namespace rholm
