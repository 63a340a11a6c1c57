// Fewer triangles for the surface of all tiles. Layer: reconstruct, private.
//
// Each tile is simplified with the vertices that it shares with others locked,
// and all tiles to the same cost of a vertex. The strips along the faces between
// tiles follow: first between the tiles of one group, gathered at a time, then
// between the groups of a group of groups. The quadrics of vertices go from each
// step to the next, so that errors are distances from the given surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "parts/store.h"
#include "reconstruct/surface/tile_gather.h"
#include "reconstruct/surface/tile_parts.h"
#include "reconstruct/surface/tile_surface.h"
#include "rholm/context.h"
#include "rholm/simplify.h"
#include "shape/simplify/simplify_part.h"

namespace rholm {

struct TileSimplifyOptions {
  SimplifyOptions stops = {};  // at least one is set
  std::uint64_t faces = 0;     // number of triangles of the given surface
  double step = 1;             // of the grid
  std::size_t group = 64;      // tiles whose strips are in memory at a time
};

class TileSimplify {
 public:
  // `parts` says which triangles of the surface stay, and outlives this.
  TileSimplify(PieceStore& store, TileSurface& surface, const TileParts& parts, std::size_t n_tiles,
               const TileSimplifyOptions& options);

  // Finds how the cost grows as triangles go: "curve/TILE". Only if wants_curves().
  bool wants_curves() const { return n_tiles_ > 1 && most_ > 0; }
  void find_curve(std::size_t tile, const Context& context);
  bool has_curve(std::size_t tile) const;
  // Chooses the number of triangles of each tile, after find_curve() of all.
  void choose();

  // Level 0 is each tile by itself, the others are strips between groups. Each level takes begin(),
  // work() on all groups that has() does not know, in any order, end() by one process, and take().
  std::size_t n_levels() const;
  void begin(std::size_t level);
  std::size_t n_groups() const;
  bool has(std::size_t group) const;
  void work(std::size_t group, const Context& context);
  void end();
  void take();
  // Returns Simplification::error, once all is done.
  double error() const;

 private:
  using Name = TileSurface::VertexOfTile;
  using Planes = std::vector<std::pair<Name, PlaneQuadric>>;  // by names

  SimplifyPart whole_part(std::size_t tile, const TileMesh& mesh) const;
  // Finds the vertices that tiles of different groups share; a group has `group` tiles.
  void find_shared(std::size_t group);
  bool is_shared(const Name& name) const;
  std::vector<std::uint8_t> near_shared(std::size_t tile, const TileMesh& mesh) const;
  void simplify(std::size_t tile, const Context& context);
  void join(std::size_t group, const Context& context);
  std::size_t group_of(std::size_t level) const;  // tiles
  Planes read_planes(std::size_t level, std::size_t first, std::size_t end) const;
  void write_planes(std::size_t level, std::size_t number, const Planes& planes,
                    double error) const;
  std::uint64_t count_triangles() const;

  PieceStore& store_;
  TileSurface& surface_;
  const TileParts& parts_;
  std::size_t n_tiles_;
  TileSimplifyOptions options_;
  std::uint64_t most_ = 0;                   // triangles wanted, 0: the error decides
  std::vector<Name> shared_ = {};            // ascending
  std::vector<std::uint64_t> targets_ = {};  // of each tile
  std::size_t level_ = 0;                    // level that is worked on
  std::string round_ = {};                   // of its meshes
  std::uint64_t to_go_ = 0;                  // excess of triangles when the level begins
  bool is_done_ = false;                     // by a run before
};

}  // namespace rholm
