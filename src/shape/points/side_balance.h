// Detects points whose normals point the wrong way. Layer: shape.
#pragma once

#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"

namespace rholm {

struct SideBalance {
  // True if normals all around a solid point inwards: the volume (Gauss) is negative by more than
  // chance. False if points do not surround anything.
  bool inwards = false;
  // Length of the mean normal: 0 for a closed surface, 1/2 for half a sphere, 1 for a plane.
  double one_sided = 1;
};

// Takes points and unit normals in the order of the tree.
SideBalance balance_sides(const PointTree& tree, std::span<const Vec3> points,
                          std::span<const Vec3> normals, const Context& context);

// Takes some points, and the relative area that each one stands for.
SideBalance balance_of(std::vector<double> areas, std::span<const Vec3> points,
                       std::span<const Vec3> normals);

}  // namespace rholm
