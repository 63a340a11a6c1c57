#include "model/bricks/brick_halo.h"

#include <utility>

#include "model/bricks/brick_caps.h"

namespace rholm {

BrickAndHalo read_with_halo(const PieceStore& store, const BrickPlan& plan, std::size_t brick,
                            double halo) {
  BrickAndHalo points;
  points.cloud = read_points(store, brick);
  points.n_own = points.cloud.points.size();
  if (points.n_own == 0 || !(halo > 0)) return points;
  const Bounds box = grown(read_index(store, brick).bounds(), halo);
  for (const std::size_t other : plan.bricks_meeting(box)) {
    if (other == brick) continue;
    BrickAndHalo::Part part{.brick = other};
    add_points_within(store, other, box, points.cloud, &part.places);
    if (!part.places.empty()) points.halo.push_back(std::move(part));
  }
  return points;
}

}  // namespace rholm
