// What windows leave of sums at scattered directions: relative errors, l2, of generic sums (random
// signs, even directions), all measured by bench/window_bench. Degrees are L, oversampling is sigma
// = n / (2 L) for n points a turn.
#pragma once

#include <cstddef>

namespace rholm {

// Of values, with windows of this width.
double window_error(int width, double sigma);

// How much larger than that of values the error of derivatives is: of gradients relative to L, of
// Hessians, `sources` of them all over the sphere, relative to L^2.
double gradient_factor(double sigma);
double hessian_factor(double sigma, int degree, std::size_t sources);

// A gradient counts as a weight so many times its size, while oversampling is not known yet: some
// 9 L, at the twofold one. Where it is known, sums of squares that count gradients so are at most
// the square of this factor too small.
double gradient_as_weight(int degree);
double counted_gradient_factor(double sigma);

// What windows in single precision add (L = 16 ... 2000, up to 2.2e-7 for values and gradients,
// with windows up to 10 wide).
double single_rounding(int degree, int derivatives = 0);
// Least error that single precision is taken for.
double least_single_error(int degree, int derivatives = 0);

}  // namespace rholm
