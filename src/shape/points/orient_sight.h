// Computes signs of normals by the line of sight. Layer: shape.
#pragma once

#include <span>

#include "rholm/vec3.h"
#include "shape/points/normals.h"
#include "shape/points/orient_signs.h"

namespace rholm {

// Flips the fits' normals towards the sensors, one per point, or away from sensors inside the body.
// The agreement is the cosine of the angle between normal and line of sight.
OrientSigns turn_by_sight(std::span<const Vec3> points, const LocalFits& fits,
                          std::span<const Vec3> sensors, bool from_inside);

// Flips points seen at a glancing angle to agree with better-seen neighbours.
void turn_glancing(std::span<const Vec3> points, const LocalFits& fits, OrientSigns& signs);

}  // namespace rholm
