// Points that belong to no surface, removed from tiles. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "parts/store.h"
#include "reconstruct/points/tile_plan.h"
#include "reconstruct/points/tile_scene.h"
#include "rholm/context.h"

namespace rholm {

// One removal of points from all tiles: first the points of each tile are examined with its halo,
// then all are removed. A step is skipped where the store already has its result.
class TileRemoval {
 public:
  // `name` distinguishes this removal from the other removals of the same run.
  TileRemoval(PieceStore& store, const TilePlan& plan, std::string name);

  bool has_found(std::size_t tile) const;
  // Stores one flag per point of the tile, in their order: 1 for a point to remove.
  void put(std::size_t tile, const std::vector<std::uint8_t>& flags);
  // Returns the flags that put() stored, before the points are removed.
  std::vector<std::uint8_t> flags(std::size_t tile) const;
  // Returns the number of points to remove from all tiles, after put() for all of them.
  std::uint64_t count() const;
  // Removes the points with flag 1 from "points/TILE", and their computed normals.
  void remove(std::size_t tile);

 private:
  std::string found(std::size_t tile) const;
  std::string done(std::size_t tile) const;
  PieceReader head(std::size_t tile) const;

  PieceStore& store_;
  const TilePlan& plan_;
  std::string name_;
};

// Returns one flag per own point: 1 where the point is far from all others, alone or in a small
// group (find_isolated_points()). Each of the `looks` leaves out the points that earlier looks have
// found. `neighbors`, if it is given, gets graph_neighbors() of all points of the scene.
std::vector<std::uint8_t> find_isolated_in_tile(const TileScene& scene, int looks,
                                                const Context& context,
                                                std::vector<std::uint32_t>* neighbors);

}  // namespace rholm
