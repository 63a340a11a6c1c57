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
  std::optional<Vec3> sensor = {};  // of all; else those of the attributes
};

class TileSeen {
 public:
  TileSeen(PieceStore& store, std::size_t n_tiles, const TileSight& sight)
      : store_(store), n_tiles_(n_tiles), sight_(sight) {}

  // The cubes that a tile's lines of sight go through: "seen/TILE".
  void find(std::size_t tile, const Context& context);
  bool has(std::size_t tile) const;
  // Once all are there; none if some point has no sensor.
  std::optional<SeenSpace> join(const Context& context) const;

 private:
  PieceStore& store_;
  std::size_t n_tiles_;
  TileSight sight_;
};

}  // namespace rholm
