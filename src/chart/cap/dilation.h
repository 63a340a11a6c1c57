// The stereographic dilation of the sphere, tan(theta'/2) = a tan(theta/2), about the axis z
// (method 7.1). Layer: chart.
#pragma once

#include "rholm/vec3.h"

namespace rholm {

// The a that opens `angle` to `opened`; radians, both within 0 ... pi.
double dilation_between(double angle, double opened);

// d theta' / d theta at the cosine of theta, the same in all directions, (K1).
double conformal_factor(double a, double cosine);

// A unit vector on the dilated sphere.
Vec3 dilated(double a, const Vec3& u);

}  // namespace rholm
