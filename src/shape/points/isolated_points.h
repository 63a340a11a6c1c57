// Finds isolated points, far from any surface, from coordinates alone. Layer: shape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

// Returns one flag per point: 1 if it is farther than twenty diagonals from the middle of a box.
// The box holds all but one in two hundred points on either side. Far points would spoil single
// precision and tolerances relative to the extent. Points need not be finite.
std::vector<std::uint8_t> find_far_isolated_points(std::span<const Vec3> points);

// The ball outside of which points are isolated. Its radius is 0 if there are too few points, or
// nearly all are at one place; then no point is isolated.
struct FarBall {
  Vec3 middle = {};
  double radius = 0;
  bool is_far(const Vec3& p) const { return radius > 0 && norm(p - middle) > radius; }
};
FarBall find_far_ball(std::span<const Vec3> points);

// Number of passes. Later passes find isolated points that were hidden by ones now removed.
inline constexpr int kIsolatedPasses = 3;

// Returns one flag per point, in the order of the tree: 1 for isolated points at any distance.
// These are single points or small groups, farther from others than their neighbours are from
// theirs. A group that fills a volume, more thinly than the largest group its surface, is flagged
// too. Needs no normals. `neighbors`, if given, receives graph_neighbors().
std::vector<std::uint8_t> find_isolated_points(const PointTree& tree, std::span<const Vec3> points,
                                               const SamplingGaps& gaps, const Context& context,
                                               std::vector<std::uint32_t>* neighbors = nullptr);

}  // namespace rholm
