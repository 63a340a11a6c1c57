// Points far from any surface, told from places alone. Layer: shape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

// One flag per point: 1 for those far outside the box that holds nearly all (all but one in two
// hundred on either side), twenty diagonals from its middle. Single precision, and what a tolerance
// relative to all points means, would suffer from them. Points need not be finite.
std::vector<std::uint8_t> find_far_strays(std::span<const Vec3> points);

// The ball beyond which they are. Radius 0: there are none, for the points are too few or nearly
// all at one place.
struct FarBall {
  Vec3 middle = {};
  double radius = 0;
  bool is_far(const Vec3& p) const { return radius > 0 && norm(p - middle) > radius; }
};
FarBall find_far_ball(std::span<const Vec3> points);

// Once the ones found are gone, a second and a third look find those that they have hidden.
inline constexpr int kStrayPasses = 3;

// One flag per point, in the order of the tree: 1 for a point that is farther from the others than
// both have neighbours, alone or in a group of a few, and for those of a group that fills a volume
// more thinly than the largest group its surface: outliers, at any distance. Normals are not
// needed. `neighbors`, if it is given, gets graph_neighbors(), which are found on the way.
std::vector<std::uint8_t> find_strays(const PointTree& tree, std::span<const Vec3> points,
                                      const SamplingGaps& gaps, const Context& context,
                                      std::vector<std::uint32_t>* neighbors = nullptr);

}  // namespace rholm
