#include "harmonic/nonuniform/window_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harmonic/nonuniform/polar_nodes.h"

namespace rholm {

// window.h gives the rate. bench/window_bench measures the factor: 1.3 at sigma = 1.25, 1.9 at 1.5,
// 3 at 2, 4.7 at 2.8, within 30 % for widths 3 ... 16.
double window_error(int width, double sigma) {
  return (2.1 * sigma - 1.2) * std::exp(-std::numbers::pi * width * std::sqrt(1 - 1 / sigma));
}

// Aliases have wave numbers around n - L, and derivatives in phi near the poles count
// 1 / sin(theta) times. Down to a polar sine, the l2 norm of 1 / sin^2 is 0.7 times the inverse of
// the polar sine. The norm counts three times if fewer than thirty sources are within twice the
// polar sine (chosen).
constexpr double kGradientAsWeight = 9;  // gradient_factor() at an oversampling of 1.86
double gradient_factor(double sigma) { return 2.6 * sigma * sigma; }
double hessian_factor(double sigma, int degree, std::size_t sources) {
  const double sine = polar_sine(degree, 2);
  const bool few = 2 * sine * sine * static_cast<double>(sources) < 30;
  const double near = (few ? 70 : 24) * std::pow(sigma - 1, 1.8);
  return 4 + near / sine;
}

double gradient_as_weight(int degree) { return kGradientAsWeight * std::max(degree, 1); }
double counted_gradient_factor(double sigma) {
  return std::max(1.0, gradient_factor(sigma) / kGradientAsWeight);
}

// Second differences near the poles divide the rounding of values by the square of their step.
double single_rounding(int degree, int derivatives) {
  constexpr double kValues = 2.5e-7;
  return derivatives > 1 ? kValues + 3.5e-6 * polar_sine(degree, derivatives) : kValues;
}
double least_single_error(int degree, int derivatives) {
  return 1.4 * single_rounding(degree, derivatives);
}

}  // namespace rholm
