// Space that scanners have seen to be empty, by the points of all bricks. Layer: model, private.
#pragma once

#include <cstddef>
#include <optional>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_plan.h"
#include "rholm/context.h"
#include "rholm/topology.h"
#include "rholm/vec3.h"
#include "surface/holes/seen_space.h"

namespace rholm {

struct BrickSight {
  Bounds box = {};                  // of the points
  double edge = 0;                  // of cubes
  double margin = 0;                // before points
  std::optional<Vec3> sensor = {};  // of all; else those of the attributes
};

class BrickSeen {
 public:
  BrickSeen(PieceStore& store, std::size_t n_bricks, const BrickSight& sight)
      : store_(store), n_bricks_(n_bricks), sight_(sight) {}

  // The cubes that a brick's lines of sight go through: "seen/BRICK".
  void find(std::size_t brick, const Context& context);
  bool has(std::size_t brick) const;
  // Once all are there; none if some point has no sensor.
  std::optional<SeenSpace> join(const Context& context) const;

 private:
  PieceStore& store_;
  std::size_t n_bricks_;
  BrickSight sight_;
};

}  // namespace rholm
