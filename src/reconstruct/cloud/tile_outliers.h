// Outliers near the surface, in tiles. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "parts/stages.h"
#include "parts/store.h"
#include "reconstruct/points/tile_plan.h"
#include "reconstruct/points/tile_scene.h"
#include "rholm/context.h"

namespace rholm {

// Groups of points through all tiles. Two near neighbours with normals that agree are in the same
// group (see for_links_of_groups()).
class TileGroups {
 public:
  TileGroups(PieceStore& store, std::size_t n_tiles) : store_(store), n_tiles_(n_tiles) {}

  // Finds the groups of a tile's own points, and their points in other tiles: "groups/TILE".
  void find(std::size_t tile, const TileScene& scene, const Context& context);
  bool has(std::size_t tile) const;
  // Must be called after find() of all tiles.
  void join(std::uint64_t least);
  // Returns one flag per point of the tile: 1 for groups of fewer than `least`. After join().
  std::vector<std::uint8_t> small(std::size_t tile) const;
  void remove(std::size_t tile);

 private:
  struct Link {
    std::uint32_t tile = 0, point = 0, group = 0;  // a point of that tile, a group of this one
    auto operator<=>(const Link&) const = default;
  };

  PieceStore& store_;
  std::size_t n_tiles_;
  std::vector<std::vector<std::uint8_t>> small_ = {};  // of each tile's groups
};

struct OutlierSearch {
  std::uint64_t n_points = 0;  // of all tiles
  std::uint64_t most = 0;
  double noise = 0;
  // Returns a tile with its halo, as both are at the time of the call.
  std::function<std::shared_ptr<const TileScene>(std::size_t tile)> load;
  // Called once points have been removed from tiles.
  std::function<void()> changed = [] {};
  // Returns the places in a tile of points that no cap fits; empty before there are caps. If more
  // than `most` points look like outliers, they are fine features with few points: then only points
  // that no cap fits are removed.
  std::function<std::vector<std::uint32_t>(std::size_t tile)> suspects = {};
};

// Removes outliers near the surface, which their normals tell, and returns how many. Steps that an
// earlier run has done are not repeated; `n_points` is the number before any removal.
std::uint64_t remove_tile_outliers(PieceStore& store, const TilePlan& plan,
                                   const OutlierSearch& search, Stages& stages);

}  // namespace rholm
