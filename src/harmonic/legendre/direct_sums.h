// Direct sums over scattered directions, O(N L^2): the oracle, also used for small numbers N.
#pragma once

#include <span>
#include <vector>

#include "rholm/harmonic.h"

namespace rholm {

std::vector<double> direct_evaluate(const Coefficients& coefficients,
                                    std::span<const Vec3> directions, const Context& context);
ValuesAndGradients direct_evaluate_with_gradient(const Coefficients& coefficients,
                                                 std::span<const Vec3> directions,
                                                 const Context& context);
void direct_add_adjoint(const ScatteredSources& sources, Coefficients& sum, const Context& context);

}  // namespace rholm
