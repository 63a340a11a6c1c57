#include <algorithm>
#include <cmath>
#include <limits>

#include "harmonic/fft/fft.h"
#include "harmonic/nonuniform/nonuniform.h"

namespace rholm {
namespace {

// The cost model, nanoseconds of one core at 2.5 GHz with AVX-512; only ratios matter. Measured
// with bench/nonuniform_bench: smallest of many runs.

// Spreading one source: base + row * width, for values, gradients and Hessians; rows of up to 8
// taps and of 16. Interpolation takes as long within a quarter.
struct SourceCost {
  double base, row;
};
constexpr SourceCost kSingle[2][3] = {{{3.7, 1.25}, {4.7, 1.8}, {5.6, 2.65}},
                                      {{4.7, 1.7}, {3.5, 2.7}, {4.8, 4.0}}};
constexpr SourceCost kDouble[2][3] = {{{6.6, 2.15}, {8.9, 3.0}, {13.0, 4.2}},
                                      {{7.2, 3.3}, {8.0, 4.8}, {12.0, 6.7}}};
// One cell: clearing fresh memory, folding, untangling, gathering. One of a further grid.
constexpr double kCellSingle = 2.4, kCellDouble = 4.5;
constexpr double kMoreSingle = 1.6, kMoreDouble = 3.2;
// Fourier transforms of n complex numbers: n log2(n) times this, more for lengths with a factor 25
// above 400.
constexpr double kFftSingle = 0.17, kFftDouble = 0.30, kSlowLength = 1.5;
// Legendre sums: one ring pair and one (l, m); one order.
constexpr double kRingTerm = 0.19, kOrder = 1500;
// Direct sums: one source and one (l, m), value only.
constexpr double kDirectTerm = 0.35;

constexpr double kSmallSigma = 1.15, kLargeSigma = 4;

double source_cost(int width, bool single, int derivatives) {
  const SourceCost& cost = (single ? kSingle : kDouble)[width > 8][derivatives];
  return cost.base + cost.row * width;
}

double fft_cost(std::size_t points, bool single) {
  const double n = static_cast<double>(points);
  const double slow = points > 400 && points % 25 == 0 ? kSlowLength : 1;
  return slow * (single ? kFftSingle : kFftDouble) * n * std::log2(n);
}

double stage_cost(const SphereFourier& fourier, bool single, std::size_t grids) {
  const GridLayout& layout = fourier.layout;
  const double orders = fourier.degree + 1.0, rings = static_cast<double>(fourier.n_rings);
  const double row = fft_cost(layout.n_phi / 2, single);
  const double circles = fft_cost(layout.n_theta, single) + fft_cost(2 * fourier.n_rings, single);
  const double cell = (single ? kCellSingle : kCellDouble) +
                      static_cast<double>(grids - 1) * (single ? kMoreSingle : kMoreDouble);
  return static_cast<double>(layout.cells()) * cell + static_cast<double>(layout.rows) * row +
         0.5 * orders * circles + 0.25 * orders * orders * rings * kRingTerm + orders * kOrder;
}

// Sine of the colatitude below which derivatives are taken from values around them (chosen: 16
// values for a gradient, 34 for a Hessian, which adds 1 to 3 ns to the mean source).
double polar_sine(int degree, int derivatives) {
  const double least = static_cast<double>(derivatives) / std::max(degree, 1);
  return derivatives > 1 ? std::max(least, 0.05) : least;
}

// How much larger than that of values the error of derivatives is, measured on even directions,
// relative to L for gradients and L^2 for Hessians. Aliases have wave numbers around n - L, and
// longitudes near the poles count 1 / sin(theta) times: the l2 norm of 1 / sin^2 down to a polar
// sine is 0.7 times its inverse, and three times that where few sources are so near: fewer than
// thirty within twice the polar sine (chosen).
double gradient_factor(double sigma) { return 2.6 * sigma * sigma; }
double hessian_factor(double sigma, int degree, std::size_t sources) {
  const double sine = polar_sine(degree, 2);
  const bool few = 2 * sine * sine * static_cast<double>(sources) < 30;
  const double near = (few ? 70 : 24) * std::pow(sigma - 1, 1.8);
  return 4 + near / sine;
}

double predicted_error(const NonuniformNeeds& needs, int width, double sigma) {
  const double degree = std::max(needs.degree, 1);
  // The largest of many draws is 1.3 times the typical one; few degrees make for less average.
  const double error = spread_error(width, sigma) * 1.3 * (1 + 4 / degree);
  double derivatives = 1;
  if (needs.derivatives > 0) {
    derivatives = std::max(derivatives, needs.gradient_size * gradient_factor(sigma));
  }
  if (needs.derivatives > 1) {
    derivatives = std::max(
        derivatives, needs.hessian_size * hessian_factor(sigma, needs.degree, needs.spread_out));
  }
  return error * derivatives;
}

// What the windows may add to the rounding of single precision.
double window_share(double error, double rounding) {
  return std::sqrt(std::max(error * error - rounding * rounding, 0.0));
}

// The grids that a width has to be tried with: the smallest that is good enough and the next.
template <typename Visit>
void visit_grids(const NonuniformNeeds& needs, int width, double error, const Visit& visit) {
  constexpr std::size_t kLeastPoints = 32;  // caps of 16 rows must not meet
  const double turn = 2.0 * std::max(needs.degree, 1);
  std::size_t points = smooth_length(
      std::max(kLeastPoints, static_cast<std::size_t>(std::ceil(kSmallSigma * turn))), 4);
  for (int found = 0; found < 2; points = smooth_length(points + 1, 4)) {
    const double sigma = static_cast<double>(points) / turn;
    if (sigma > kLargeSigma && points > kLeastPoints) return;
    if (predicted_error(needs, width, sigma) > error) continue;
    visit(points);
    ++found;
  }
}

}  // namespace

double hessian_factor(const NonuniformPlan& plan, std::size_t sources) {
  const double turn = 2.0 * std::max(plan.fourier.degree, 1);
  const double sigma = static_cast<double>(plan.fourier.layout.n_phi) / turn;
  return hessian_factor(sigma, plan.fourier.degree, sources);
}

// Second differences near the poles divide the rounding of values by the square of their step.
double single_rounding(int degree, int derivatives) {
  constexpr double kValues = 2.5e-7;
  return derivatives > 1 ? kValues + 3.5e-6 * polar_sine(degree, derivatives) : kValues;
}
double least_single_error(int degree, int derivatives) {
  return 1.4 * single_rounding(degree, derivatives);
}

double direct_cost(const NonuniformNeeds& needs) {
  const double l = needs.degree + 1.0;
  // Gradients are three sums more, Hessians ten.
  const double sums = needs.derivatives == 0 ? 1 : needs.derivatives == 1 ? 4 : 14;
  return static_cast<double>(needs.sources) * l * (l + 1) / 2 * kDirectTerm * sums;
}

NonuniformPlan plan_nonuniform(const NonuniformNeeds& needs) {
  NonuniformPlan best;
  best.cost = std::numeric_limits<double>::infinity();
  best.single =
      !needs.forbid_single && needs.error >= least_single_error(needs.degree, needs.derivatives);
  best.polar_sine = polar_sine(needs.degree, needs.derivatives);
  const double error =
      best.single ? window_share(needs.error, single_rounding(needs.degree, needs.derivatives))
                  : needs.error;
  // Wide windows on coarse grids range over so many powers of ten that single precision loses
  // another digit.
  constexpr int kMaxSingleWidth = 10;
  const int widest = best.single ? kMaxSingleWidth : kMaxSpreadWidth;
  for (int width = kMinSpreadWidth; width <= widest; ++width) {
    visit_grids(needs, width, error, [&](std::size_t points) {
      NonuniformPlan plan = best;
      plan.fourier = sphere_fourier(needs.degree, grid_layout(width, points, points));
      const std::size_t grids = grid_count(plan, needs.sources);
      plan.cost =
          stage_cost(plan.fourier, plan.single, grids) +
          static_cast<double>(needs.sources) * source_cost(width, plan.single, needs.derivatives);
      if (plan.cost < best.cost) best = plan;
    });
  }
  if (best.fourier.layout.width == 0) {
    // Beyond what windows can do: the best there is, at a price that lets direct sums be taken.
    const std::size_t points = smooth_length(
        std::max<std::size_t>(32, 5 * static_cast<std::size_t>(std::max(needs.degree, 1))), 4);
    best.fourier = sphere_fourier(needs.degree, grid_layout(kMaxSpreadWidth, points, points));
  }
  return best;
}

}  // namespace rholm
