// The integrals of monte_carlo.h by rules with fixed nodes, to compare with random points.
#pragma once

#include <cstddef>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "transform/geometry/star_geometry.h"

namespace rholm::paper {

// Integrates over the scaled geometry with `points` Gauss nodes on each edge. The field starts as
// in (M2): it is smooth along an edge except near the axis, where the rule converges slowly.
Coefficients edge_rule_sum(const StarGeometry& geometry, int degree, int points,
                           const Context& context);

// Integrates r dOmega over flat faces by a rule that is exact to `exactness`.
Coefficients triangle_rule_sum(const StarGeometry& geometry, int degree, int exactness,
                               const Context& context);
std::size_t triangle_rule_points(int exactness);

}  // namespace rholm::paper
