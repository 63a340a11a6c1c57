// Signs of normals by the line of sight. Layer: shape.
#pragma once

#include <span>

#include "rholm/vec3.h"
#include "shape/points/normals.h"
#include "shape/points/orient_signs.h"

namespace rholm {

// Normals of the fits point to the sensors, one per point, or away from them where these are inside
// of what they see. Agreement is the cosine of the angle between normal and line of sight.
OrientSigns turn_by_sight(std::span<const Vec3> points, const LocalFits& fits,
                          std::span<const Vec3> sensors, bool from_inside);

// What is seen at a glancing angle agrees with what is seen better around it.
void turn_glancing(std::span<const Vec3> points, const LocalFits& fits, OrientSigns& signs);

}  // namespace rholm
