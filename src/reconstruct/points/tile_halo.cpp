#include "reconstruct/points/tile_halo.h"

#include <utility>

#include "reconstruct/caps/tile_caps.h"

namespace rholm {

TileAndHalo read_with_halo(const PieceStore& store, const TilePlan& plan, std::size_t tile,
                           double halo) {
  TileAndHalo points;
  points.cloud = read_points(store, tile);
  points.n_own = points.cloud.points.size();
  if (points.n_own == 0 || !(halo > 0)) return points;
  const Bounds box = grown(read_index(store, tile).bounds(), halo);
  for (const std::size_t other : plan.tiles_meeting(box)) {
    if (other == tile) continue;
    TileAndHalo::Part part{.tile = other};
    add_points_within(store, other, box, points.cloud, &part.places);
    if (!part.places.empty()) points.halo.push_back(std::move(part));
  }
  return points;
}

}  // namespace rholm
