// Points that belong to no surface, removed from bricks. Layer: model, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_plan.h"
#include "rholm/context.h"

namespace rholm {

// One removal from all bricks: each is looked at with its halo as it was before, then all lose what
// was found. Either step is done already where the store has it from a run before.
class BrickRemoval {
 public:
  // `name` tells it from others of the same run.
  BrickRemoval(PieceStore& store, const BrickPlan& plan, std::string name);

  bool has_found(std::size_t brick) const;
  // One flag per point of the brick, in their order: 1 of those to remove.
  void put(std::size_t brick, const std::vector<std::uint8_t>& flags);
  // What was put, before it is removed.
  std::vector<std::uint8_t> flags(std::size_t brick) const;
  // How many, of all bricks, once they are all looked at.
  std::uint64_t count() const;
  // Removes them from "points/BRICK", and their computed normals.
  void remove(std::size_t brick);

 private:
  std::string found(std::size_t brick) const;
  std::string done(std::size_t brick) const;
  PieceReader head(std::size_t brick) const;

  PieceStore& store_;
  const BrickPlan& plan_;
  std::string name_;
};

// Those far from all others, alone or in small groups: find_strays(), with points of other bricks
// in a box that is wider by `halo`.
std::vector<std::uint8_t> find_brick_strays(const PieceStore& store, const BrickPlan& plan,
                                            std::size_t brick, double halo, const Context& context);

}  // namespace rholm
