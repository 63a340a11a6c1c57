// Relative l2 errors that windows cause in generic sums at scattered directions (random signs,
// uniform directions), all measured by bench/window_bench. L is the degree, and sigma = n / (2 L)
// the oversampling for n points per turn.
#pragma once

#include <cstddef>

namespace rholm {

// Returns the error of values, with windows of this width.
double window_error(int width, double sigma);

// Return the ratio of the error of derivatives to the error of values. Gradients are relative to L,
// Hessians of `sources` sources all over the sphere relative to L^2.
double gradient_factor(double sigma);
double hessian_factor(double sigma, int degree, std::size_t sources);

// A gradient counts as a weight with the factor gradient_as_weight() while sigma is unknown: 9 L,
// for sigma = 1.86. Once sigma is known, sums of squares with this factor are too small by at most
// the square of counted_gradient_factor().
double gradient_as_weight(int degree);
double counted_gradient_factor(double sigma);

// Returns the error that windows in single precision add (for L = 16 ... 2000, up to 2.2e-7 for
// values and gradients, with windows up to 10 wide).
double single_rounding(int degree, int derivatives = 0);
// Returns the smallest error for which single precision is used.
double least_single_error(int degree, int derivatives = 0);

}  // namespace rholm
