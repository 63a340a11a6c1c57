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

// One removal from all tiles: each is looked at with its halo as it was before, then all lose what
// was found. Either step is done already where the store has it from a run before.
class TileRemoval {
 public:
  // `name` tells it from others of the same run.
  TileRemoval(PieceStore& store, const TilePlan& plan, std::string name);

  bool has_found(std::size_t tile) const;
  // One flag per point of the tile, in their order: 1 of those to remove.
  void put(std::size_t tile, const std::vector<std::uint8_t>& flags);
  // What was put, before it is removed.
  std::vector<std::uint8_t> flags(std::size_t tile) const;
  // How many, of all tiles, once they are all looked at.
  std::uint64_t count() const;
  // Removes them from "points/TILE", and their computed normals.
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
// group (find_strays()). Each of the `looks` leaves out the points that those before have found.
// `neighbors`, if it is given, gets graph_neighbors() of all points of the scene.
std::vector<std::uint8_t> find_tile_strays(const TileScene& scene, int looks,
                                           const Context& context,
                                           std::vector<std::uint32_t>* neighbors);

}  // namespace rholm
