#include <algorithm>
#include <cmath>
#include <limits>

#include "harmonic/fft.h"
#include "harmonic/nonuniform.h"

namespace rholm {
namespace {

// The cost model, nanoseconds of one core. All constants measured with bench/nonuniform_bench on
// an AVX-512 machine at 2.5 GHz; only their ratios matter.
constexpr double kDirectTerm = 0.35;  // one source, one (l, m), value only
constexpr double kCellSingle = 1.6;   // zeroing, transform along phi, gathering: per cell
constexpr double kCellDouble = 2.6;
constexpr double kCircle = 0.9;  // transform along theta: per point, order and bit of length
constexpr double kSmallSigma = 1.15, kLargeSigma = 4;

double spread_cost(int width, bool single, int derivatives) {
  const int padded = padded_width(width);
  const double lines = padded * (single ? 4.0 : 8.0) / 64;
  const double polynomial = 2 * (width + 4) * (1 + derivatives) * std::max(0.5, lines) * 0.25;
  const double rows = width * std::max(0.75, lines) * (0.8 + 0.25 * derivatives);
  return 4 + 2 * derivatives + polynomial + rows;
}

double grid_cost(const GridLayout& layout, int degree, bool single) {
  const double circle = static_cast<double>(layout.n_theta);
  return static_cast<double>(layout.cells()) * (single ? kCellSingle : kCellDouble) +
         0.5 * (degree + 1) * circle * kCircle * std::log2(circle) * 0.25;
}

std::size_t grid_points(int degree, double sigma) {
  const double wanted = sigma * 2 * std::max(degree, 1);
  return smooth_length(std::max<std::size_t>(32, static_cast<std::size_t>(std::ceil(wanted))), 4);
}

}  // namespace

double direct_cost(const NonuniformNeeds& needs) {
  const double l = needs.degree + 1.0;
  // Gradients are three sums more.
  return static_cast<double>(needs.sources) * l * (l + 1) / 2 * kDirectTerm *
         (1 + 3 * needs.derivatives);
}

NonuniformPlan plan_nonuniform(const NonuniformNeeds& needs) {
  NonuniformPlan best;
  best.cost = std::numeric_limits<double>::infinity();
  const bool single = !needs.forbid_single && needs.error >= kLeastSingleError;
  for (int width = kMinSpreadWidth; width <= kMaxSpreadWidth; ++width) {
    const double sigma = std::max(kSmallSigma, oversampling_for(width, needs.error));
    if (!(sigma <= kLargeSigma)) continue;
    const std::size_t points = grid_points(needs.degree, sigma);
    const GridLayout layout =
        grid_layout(width, points, points, single ? sizeof(float) : sizeof(double));
    const double cost =
        static_cast<double>(needs.sources) * spread_cost(width, single, needs.derivatives) +
        grid_cost(layout, needs.degree, single);
    if (!(cost < best.cost)) continue;
    best.cost = cost;
    best.single = single;
    best.fourier = sphere_fourier(needs.degree, layout);
  }
  best.polar_sine = static_cast<double>(needs.derivatives) / std::max(needs.degree, 1);
  return best;
}

}  // namespace rholm
