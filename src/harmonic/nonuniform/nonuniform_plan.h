// The window, grid and precision for a sum at scattered directions: the cheapest by the cost model
// that satisfies the wanted error.
#pragma once

#include <cstddef>

#include "harmonic/nonuniform/sphere_fourier.h"

namespace rholm {

// The plan for a number of sources and degrees up to L.
struct NonuniformPlan {
  SphereFourier fourier;
  bool single = false;  // spread and transformed along phi in single precision
  double cost = 0;      // predicted, nanoseconds on the machine of cost_model_bench's figures
  // Sine of the colatitude below which values around a direction give derivatives (polar_nodes.h).
  // Near a pole, derivatives in phi multiply the error by 1 / (L sin theta).
  double polar_sine = 0;
};

struct NonuniformNeeds {
  int degree = 0;
  // Allowed relative l2 error of generic sums (random signs, uniform directions).
  double allowed = 1e-12;
  std::size_t sources = 0;
  int derivatives = 0;
  bool forbid_single = false;
  // L |g| and L^2 |h| relative to |w|, root mean squares over sources. The error is relative to the
  // largest of the three; smaller values allow coarser windows. A gradient of 0 means that the
  // weights include gradients by gradient_as_weight().
  double gradient_size = 1;
  double hessian_size = 1;
  // Number of sources known to cover the sphere, as vertices of a closed surface do; 0: unknown. If
  // many of them are near the poles, the windows of Hessians may be coarser.
  std::size_t spread_out = 0;
};
// Returns the cheapest plan by the cost model (docs/performance.md).
NonuniformPlan plan_nonuniform(const NonuniformNeeds& needs);
// Returns the number of grids, with one thread each, over which sources are split. It balances the
// cost of summing grids and does not depend on the number of threads.
std::size_t grid_count(const NonuniformPlan& plan, std::size_t sources);

}  // namespace rholm
