// The frame of a cap. Layer: chart.
#pragma once

#include "rholm/cap_frame.h"

namespace rholm {

// The frame of a cap around `seed`: its centre lies below, where the support is seen under
// `half_angle`, and the sphere is opened so that this becomes `opened`. Radians; `axis` is not
// zero.
CapFrame cap_frame(const Vec3& seed, const Vec3& axis, double support, double half_angle,
                   double opened);

// x as it is seen from the centre, along the axes, in units of the radius.
Vec3 in_frame(const CapFrame& frame, const Vec3& x);

}  // namespace rholm
