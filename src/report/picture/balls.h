// How large points are drawn.
#pragma once

#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// The usual distance of neighbours, as if they lay on a square grid; the same bits for any number
// of threads. Points of the order of 1 about the origin, at least one.
double ball_radius(const std::vector<Vec3>& points, const Context& context);

}  // namespace rholm
