// Searches for the degree that keeps a tolerance. Coarse coefficients, cheap beside full precision,
// have twice as many degrees each time until their error is within it. Then a bracket follows, and
// the degree found is expanded like any other. The error of a degree is the same in all
// coefficients that have the degree, so known errors outlive each set of coefficients.
#pragma once

#include "rholm/context.h"
#include "rholm/star.h"
#include "rholm/truncation.h"
#include "transform/methods/methods.h"
#include "transform/tolerance/tolerance.h"

namespace rholm {

// `pilot` has the coefficients of first_pilot(). Pilots of higher degrees follow until their error,
// measured at points, is within the tolerance, and give the smallest degree. Coefficients of that
// degree in full precision follow. Their `errors` are set unless the tolerance is decided by
// Parseval's equation.
ToleranceTransform search_tolerance(const ToleranceProblem& problem, const Tolerance& tolerance,
                                    const Transform& pilot, const Context& context);

// Runs `expand()` with a tolerance, at the end by `method`, the direct sums of options.method.
ToleranceTransform expand_by(MethodFunction method, const StarChart& chart,
                             const Tolerance& tolerance, const TransformOptions& options,
                             const Context& context);

}  // namespace rholm
