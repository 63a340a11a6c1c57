// Points whose normals point the wrong way. Layer: shape.
#pragma once

#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"

namespace rholm {

struct SideBalance {
  // Normals of points all around a solid point into it: the volume by the theorem of Gauss is
  // negative by more than chance makes it. False where points do not surround anything.
  bool inwards = false;
  // Length of the mean normal: 0 of a closed surface, 1/2 of half a sphere, 1 of a plane.
  double one_sided = 1;
};

// Unit normals and points in the order of the tree.
SideBalance balance_sides(const PointTree& tree, std::span<const Vec3> points,
                          std::span<const Vec3> normals, const Context& context);

// Of some points, with the area that each stands for, to a common factor.
SideBalance balance_of(std::vector<double> areas, std::span<const Vec3> points,
                       std::span<const Vec3> normals);

}  // namespace rholm
