// Plane waves of directions: inner loops, in vectors.
#pragma once

#include <cstddef>

#include "rholm/vec3.h"

namespace rholm {

// cos and sin of k . x/|x| at n points x, to a few roundings; |k| at most 39000. All arrays have
// room for n rounded up to a multiple of 8, and points there that are not 0.
void wave_values(const Vec3& k, std::size_t n, const double* x, const double* y, const double* z,
                 double* cosine, double* sine);

}  // namespace rholm
