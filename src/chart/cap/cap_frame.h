// Describes the frame of a cap. Its sphere is opened about the axis z by the stereographic dilation
// tan(theta'/2) = a tan(theta/2) (method 7.1). Layer: chart.
#pragma once

#include "rholm/cap_frame.h"
#include "rholm/vec3.h"

namespace rholm {

// Returns the dilation a that maps `angle` to `opened`; both are radians within 0 ... pi.
double dilation_between(double angle, double opened);

// Returns d theta' / d theta where theta has the given cosine; equal in all directions (K1).
double conformal_factor(double a, double cosine);

// Returns the unit vector on the dilated sphere that corresponds to u.
Vec3 dilated(double a, const Vec3& u);

// Returns the frame of a cap around `seed`. The centre lies below the seed at the point from which
// the radius `support` is seen under `half_angle`. The dilation opens the sphere such that
// `half_angle` becomes `opened`. Angles are radians; `axis` is not zero.
CapFrame cap_frame(const Vec3& seed, const Vec3& axis, double support, double half_angle,
                   double opened);

// Returns x - centre along the axes of the frame, in units of the radius.
Vec3 in_frame(const CapFrame& frame, const Vec3& x);

}  // namespace rholm
