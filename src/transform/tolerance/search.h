// The search for the degree that keeps a tolerance: coarse coefficients, cheap beside those in full
// precision, of twice as many degrees each time until their error is within it, then a bracket; the
// degree that was found is analysed as any other. The error of a degree is the same in all
// coefficients that have it, so what is known outlives each set of them.
#pragma once

#include "rholm/context.h"
#include "rholm/star.h"
#include "rholm/truncation.h"
#include "transform/methods/methods.h"
#include "transform/tolerance/tolerance.h"

namespace rholm {

// `pilot`: coefficients of first_pilot(). Pilots of higher degrees follow until the error of what
// there is, measured at points, is within the tolerance, and say which degree is the smallest; then
// coefficients of that degree in full precision. Their `errors` are set where the tolerance is not
// one of Parseval's.
ToleranceAnalysis search_tolerance(const ToleranceProblem& problem, const Tolerance& tolerance,
                                   const Analysis& pilot, const Context& context);

// `analyze` of a tolerance, in the end by `method`, the direct sums of options.method.
ToleranceAnalysis analyze_by(MethodFunction method, const StarChart& chart,
                             const Tolerance& tolerance, const AnalyzeOptions& options,
                             const Context& context);

}  // namespace rholm
