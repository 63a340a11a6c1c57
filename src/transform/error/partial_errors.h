// Errors of all first degrees of coefficients at once, at a few points.
#pragma once

#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "transform/error/error_points.h"

namespace rholm {

// Returns, for each degree l of coefficients of the radius, the largest |r - r_l| at the points.
// Sums term by term, (L + 1)^2 for each point.
std::vector<double> largest_partial_errors(const ErrorPoints& points, const Coefficients& c,
                                           const Context& context);

// Returns, for each l, the largest distance of the points from the surface of the first l degrees,
// to first order: from its tangent plane on the same ray. Leaves out points within 1e-6 of a pole.
std::vector<double> largest_partial_distances(const ErrorPoints& points, const Coefficients& c,
                                              const Context& context);

}  // namespace rholm
