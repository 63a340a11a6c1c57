// Space that scanners have seen to be empty, by the points of all tiles. Layer: reconstruct,
// private.
#pragma once

#include <cstddef>
#include <optional>

#include "parts/store.h"
#include "reconstruct/points/tile_plan.h"
#include "rholm/context.h"
#include "rholm/topology.h"
#include "rholm/vec3.h"
#include "surface/holes/seen_space.h"

namespace rholm {

struct TileSight {
  Bounds box = {};                  // of the points
  double edge = 0;                  // of cubes
  double margin = 0;                // before points
  std::optional<Vec3> sensor = {};  // of all points; without it, the attributes have the sensors
};

class TileSeen {
 public:
  TileSeen(PieceStore& store, std::size_t n_tiles, const TileSight& sight)
      : store_(store), n_tiles_(n_tiles), sight_(sight) {}

  // Finds the cubes that a tile's lines of sight cross: "seen/TILE".
  void find(std::size_t tile, const Context& context);
  bool has(std::size_t tile) const;
  // After find() of all tiles; returns nullopt if some point has no sensor.
  std::optional<SeenSpace> join(const Context& context) const;

 private:
  PieceStore& store_;
  std::size_t n_tiles_;
  TileSight sight_;
};

}  // namespace rholm
