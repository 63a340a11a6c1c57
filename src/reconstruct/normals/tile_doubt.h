// Checks the normals of tiles with the winding number. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "parts/store.h"
#include "reconstruct/normals/tile_sides.h"
#include "reconstruct/points/tile_plan.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// The points of all tiles and their patches.
struct DoubtScene {
  const PieceStore& store;  // with the directions of all tiles
  const TilePlan& plan;
  const std::vector<double>& spacings;  // of tiles
  const JoinedSides& sides;
  int n_neighbors = 0;                  // of the directions
  std::uint64_t points_per_sample = 1;  // of `sides`
};

// Returns the normals of the own points of a tile.
using NormalsOfTile = std::function<std::vector<Vec3>(std::size_t tile)>;
// Returns the directions of a tile's own points, with the signs that `sides` gives.
std::vector<Vec3> joined_normals(const DoubtScene& scene, std::size_t tile);

// Estimates doubtful_share() of all points (orient_sides.h), evaluated `radii` away, at some points
// of some tiles. The field is from all points near a tile and from the samples beyond, with
// `sample_normals`. Patches are `spread` times as coarse as for clean points.
double doubtful_share(const DoubtScene& scene, double radii, double spread,
                      const NormalsOfTile& normals_of, std::span<const Vec3> sample_normals,
                      const Context& context);

}  // namespace rholm
