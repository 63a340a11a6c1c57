// The integrals of monte_carlo.h by rules of fixed nodes: what random points compare with.
#pragma once

#include <cstddef>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "transform/geometry/star_geometry.h"

namespace rholm::paper {

// Of the scaled geometry. `points` Gauss nodes on each edge, the field started as in (M2): smooth
// along an edge but near the axis, where this converges slowly.
Coefficients edge_rule_sum(const StarGeometry& geometry, int degree, int points,
                           const Context& context);

// r dOmega on flat faces by a rule exact to `exactness`, of triangle_rule_points() nodes.
Coefficients triangle_rule_sum(const StarGeometry& geometry, int degree, int exactness,
                               const Context& context);
std::size_t triangle_rule_points(int exactness);

}  // namespace rholm::paper
