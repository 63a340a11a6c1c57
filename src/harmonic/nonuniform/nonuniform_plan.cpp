#include "harmonic/nonuniform/nonuniform_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harmonic/fft/fft.h"
#include "harmonic/nonuniform/cost_model.h"
#include "harmonic/nonuniform/polar_nodes.h"
#include "harmonic/nonuniform/window_error.h"

namespace rholm {
namespace {

// Range of oversampling to try (chosen: plans of the table in docs/performance.md have 1.5 to 3.2).
constexpr double kSmallSigma = 1.15, kLargeSigma = 4;

double predicted_error(const NonuniformNeeds& needs, int width, double sigma) {
  const double degree = std::max(needs.degree, 1);
  // The largest of many errors is 1.3 times the typical one; low degrees average over less.
  const double error = window_error(width, sigma) * 1.3 * (1 + 4 / degree);
  double derivatives = 1;
  if (needs.derivatives > 0) {
    derivatives = needs.gradient_size > 0
                      ? std::max(derivatives, needs.gradient_size * gradient_factor(sigma))
                      : counted_gradient_factor(sigma);
  }
  if (needs.derivatives > 1) {
    derivatives = std::max(
        derivatives, needs.hessian_size * hessian_factor(sigma, needs.degree, needs.spread_out));
  }
  return error * derivatives;
}

// Returns the error that windows may add to the rounding of single precision.
double window_share(double allowed, double rounding) {
  return std::sqrt(std::max(allowed * allowed - rounding * rounding, 0.0));
}

// Calls visit(points) for the grids to try for a width: the smallest accurate one, and the next.
template <typename Visit>
void visit_grids(const NonuniformNeeds& needs, int width, double allowed, const Visit& visit) {
  constexpr std::size_t kLeastPoints = 32;  // caps of 16 rows must not meet
  const double turn = 2.0 * std::max(needs.degree, 1);
  std::size_t points = smooth_length(
      std::max(kLeastPoints, static_cast<std::size_t>(std::ceil(kSmallSigma * turn))), 4);
  for (int found = 0; found < 2; points = smooth_length(points + 1, 4)) {
    const double sigma = static_cast<double>(points) / turn;
    if (sigma > kLargeSigma && points > kLeastPoints) return;
    if (predicted_error(needs, width, sigma) > allowed) continue;
    visit(points);
    ++found;
  }
}

}  // namespace

std::size_t grid_count(const NonuniformPlan& plan, std::size_t sources) {
  // A further grid is used if it costs less than a twentieth of the work, up to eight grids. A
  // second grid is always used if a second thread is worthwhile (chosen).
  constexpr double kWorkPerGrid = 20;
  const double work = typical_source_cost() * static_cast<double>(sources);
  const double grid = typical_cell_cost() * static_cast<double>(plan.fourier.layout.cells());
  return static_cast<std::size_t>(std::clamp(work / (kWorkPerGrid * grid), 1.0, 7.0)) +
         (work > second_thread_cost());
}

NonuniformPlan plan_nonuniform(const NonuniformNeeds& needs) {
  NonuniformPlan best;
  best.cost = std::numeric_limits<double>::infinity();
  best.single =
      !needs.forbid_single && needs.allowed >= least_single_error(needs.degree, needs.derivatives);
  best.polar_sine = polar_sine(needs.degree, needs.derivatives);
  const double allowed =
      best.single ? window_share(needs.allowed, single_rounding(needs.degree, needs.derivatives))
                  : needs.allowed;
  // Values of wide windows on coarse grids span a range of powers of ten in which single precision
  // loses another digit.
  constexpr int kMaxSingleWidth = 10;
  const int widest = best.single ? kMaxSingleWidth : kMaxSpreadWidth;
  for (int width = kMinSpreadWidth; width <= widest; ++width) {
    visit_grids(needs, width, allowed, [&](std::size_t points) {
      NonuniformPlan plan = best;
      plan.fourier = sphere_fourier(needs.degree, grid_layout(width, points, points));
      const std::size_t grids = grid_count(plan, needs.sources);
      plan.cost =
          grid_cost(plan.fourier, plan.single, grids) +
          static_cast<double>(needs.sources) * source_cost(width, plan.single, needs.derivatives);
      if (plan.cost < best.cost) best = plan;
    });
  }
  if (best.fourier.layout.width == 0) {
    // No window is accurate enough: takes the best one, whose cost makes direct sums the choice.
    const std::size_t points = smooth_length(
        std::max<std::size_t>(32, 5 * static_cast<std::size_t>(std::max(needs.degree, 1))), 4);
    best.fourier = sphere_fourier(needs.degree, grid_layout(kMaxSpreadWidth, points, points));
  }
  return best;
}

}  // namespace rholm
