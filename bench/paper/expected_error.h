// The error that random points on triangles leave, without drawing them.
#pragma once

#include "rholm/star.h"

namespace rholm::paper {

// The l2 norm of the error of all coefficients to degree L with `samples` points on each triangle:
// its root mean square over all seeds.
double expected_triangle_error(const StarChart& chart, int degree, int samples);

}  // namespace rholm::paper
