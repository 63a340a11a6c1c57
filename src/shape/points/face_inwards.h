// Points whose normals point the wrong way. Layer: shape.
#pragma once

#include <span>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"

namespace rholm {

// Whether the normals of points all around a solid point into it: the volume by the theorem of
// Gauss is negative by more than chance makes it. False where points do not surround anything.
// Unit normals, both in the order of the tree.
bool face_inwards(const PointTree& tree, std::span<const Vec3> points,
                  std::span<const Vec3> normals, const Context& context);

}  // namespace rholm
