// The expected error of random points on triangles, computed without drawing points.
#pragma once

#include "rholm/star.h"

namespace rholm::paper {

// Returns the l2 norm of the error of all coefficients to degree L with `samples` points on each
// triangle, as a root mean square over all seeds.
double expected_triangle_error(const StarChart& chart, int degree, int samples);

}  // namespace rholm::paper
