// Whether the winding number contradicts normals of bricks. Layer: model, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_plan.h"
#include "model/bricks/brick_sides.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// What points and their patches are.
struct DoubtScene {
  const PieceStore& store;  // with the directions of all bricks
  const BrickPlan& plan;
  const std::vector<double>& spacings;  // of bricks
  const JoinedSides& sides;
  int n_neighbors = 0;                  // of the directions
  std::uint64_t points_per_sample = 1;  // of `sides`
};

// Normals of the own points of a brick.
using NormalsOfBrick = std::function<std::vector<Vec3>(std::size_t brick)>;
// Those of the directions, turned as `sides` says.
std::vector<Vec3> joined_normals(const DoubtScene& scene, std::size_t brick);

// The share of the points that doubtful_share() has of all, asked so many radii away, for patches
// that are `spread` times as coarse as of clean points: at some points of some bricks, in the field
// of all points near the brick, and of samples beyond, that have `sample_normals`.
double doubtful_share(const DoubtScene& scene, double radii, double spread,
                      const NormalsOfBrick& normals_of, std::span<const Vec3> sample_normals,
                      const Context& context);

}  // namespace rholm
