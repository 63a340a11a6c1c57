// The errors of all first degrees of coefficients at once, at few points.
#pragma once

#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "transform/error/error_points.h"

namespace rholm {

// Of each degree l of the coefficients, which are those of the radius: the largest |r - r_l| at the
// points. Term by term, (L + 1)^2 for each point.
std::vector<double> largest_partial_errors(const ErrorPoints& points, const Coefficients& c,
                                           const Context& context);

// The largest distance of the points to the surface of the first l degrees, to first order: to its
// tangent plane on the same ray. Points within 1e-6 of a pole are left out.
std::vector<double> largest_partial_distances(const ErrorPoints& points, const Coefficients& c,
                                              const Context& context);

}  // namespace rholm
