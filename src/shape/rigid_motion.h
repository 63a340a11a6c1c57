// Describes small motions of parts of a shape. Layer: shape.
#pragma once

#include <cmath>

#include "rholm/vec3.h"

namespace rholm {

// A rotation about `middle`, followed by a translation.
struct RigidMotion {
  Vec3 middle, shift, turn;  // turn: rotation vector in radians

  // Rotates a direction by Rodrigues' formula.
  Vec3 direction(const Vec3& v) const {
    const double angle = norm(turn);
    if (!(angle > 0)) return v;
    const Vec3 axis = turn / angle;
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
           (1 - std::cos(angle)) * dot(axis, v) * axis;
  }
  Vec3 point(const Vec3& p) const { return middle + shift + direction(p - middle); }
};

}  // namespace rholm
