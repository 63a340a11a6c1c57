// Outliers near the surface, in bricks. Layer: model, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_plan.h"
#include "model/bricks/brick_scene.h"
#include "model/bricks/brick_stages.h"
#include "rholm/context.h"

namespace rholm {

// The groups of points of find_small_groups(), through all bricks.
class BrickGroups {
 public:
  BrickGroups(PieceStore& store, std::size_t n_bricks) : store_(store), n_bricks_(n_bricks) {}

  // The groups of a brick's own points, and which points of others are of them: "groups/BRICK".
  void find(std::size_t brick, const BrickScene& scene, const Context& context);
  bool has(std::size_t brick) const;
  // Once all are there.
  void join(std::uint64_t least);
  // After join(), one flag per point of the brick: 1 for those of groups of fewer than `least`.
  std::vector<std::uint8_t> small(std::size_t brick) const;
  void remove(std::size_t brick);

 private:
  struct Link {
    std::uint32_t brick = 0, point = 0, group = 0;  // a point of that brick, a group of this one
    auto operator<=>(const Link&) const = default;
  };

  PieceStore& store_;
  std::size_t n_bricks_;
  std::vector<std::vector<std::uint8_t>> small_ = {};  // of each brick's groups
};

struct OutlierSearch {
  std::uint64_t n_points = 0;  // of all bricks
  std::uint64_t most = 0;
  double noise = 0;
  // A brick with those around it, as they are.
  std::function<BrickScene(std::size_t brick)> load;
  // Points of a brick that no cap fits, by their places there; none before there are caps.
  std::function<std::vector<std::uint32_t>(std::size_t brick)> suspects = {};
};

// As WorkingPoints::remove_outliers(), which has the rule; returns how many were removed. Steps
// that were done by a run before cost nothing: n_points is that of before.
std::uint64_t remove_brick_outliers(PieceStore& store, const BrickPlan& plan,
                                    const OutlierSearch& search, BrickStages& stages);

}  // namespace rholm
