// Whether the winding number contradicts normals of tiles. Layer: reconstruct, private.
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

// What points and their patches are.
struct DoubtScene {
  const PieceStore& store;  // with the directions of all tiles
  const TilePlan& plan;
  const std::vector<double>& spacings;  // of tiles
  const JoinedSides& sides;
  int n_neighbors = 0;                  // of the directions
  std::uint64_t points_per_sample = 1;  // of `sides`
};

// Normals of the own points of a tile.
using NormalsOfTile = std::function<std::vector<Vec3>(std::size_t tile)>;
// Those of the directions, turned as `sides` says.
std::vector<Vec3> joined_normals(const DoubtScene& scene, std::size_t tile);

// The share of the points that doubtful_share() has of all, asked so many radii away, for patches
// that are `spread` times as coarse as of clean points: at some points of some tiles, in the field
// of all points near the tile, and of samples beyond, that have `sample_normals`.
double doubtful_share(const DoubtScene& scene, double radii, double spread,
                      const NormalsOfTile& normals_of, std::span<const Vec3> sample_normals,
                      const Context& context);

}  // namespace rholm
