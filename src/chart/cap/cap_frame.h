// The frame of a cap, and its sphere opened by a stereographic dilation, tan(theta'/2) = a
// tan(theta/2), about the axis z (method 7.1). Layer: chart.
#pragma once

#include "rholm/cap_frame.h"
#include "rholm/vec3.h"

namespace rholm {

// The a that opens `angle` to `opened`; radians, both within 0 ... pi.
double dilation_between(double angle, double opened);

// d theta' / d theta at the cosine of theta, the same in all directions, (K1).
double conformal_factor(double a, double cosine);

// A unit vector on the dilated sphere.
Vec3 dilated(double a, const Vec3& u);

// The frame of a cap around `seed`: its centre lies below, where the support is seen under
// `half_angle`, and the sphere is opened so that this becomes `opened`. Radians; `axis` is not
// zero.
CapFrame cap_frame(const Vec3& seed, const Vec3& axis, double support, double half_angle,
                   double opened);

// x as it is seen from the centre, along the axes, in units of the radius.
Vec3 in_frame(const CapFrame& frame, const Vec3& x);

}  // namespace rholm
