// Which window, grid and precision a sum at scattered directions gets: the cheapest by the cost
// model that keeps the wanted error.
#pragma once

#include <cstddef>

#include "harmonic/nonuniform/sphere_fourier.h"

namespace rholm {

// For `sources` sources up to degree L.
struct NonuniformPlan {
  SphereFourier fourier;
  bool single = false;  // spread and transformed along phi in single precision
  double cost = 0;      // predicted, nanoseconds on the machine of cost_model_bench's figures
  // Derivatives nearer to a pole are taken from values around them (polar_nodes.h): longitudes
  // there multiply the window's error by 1 / (L sin theta).
  double polar_sine = 0;
};

struct NonuniformNeeds {
  int degree = 0;
  // What may be left of generic sums (random signs, even directions): relative, l2.
  double allowed = 1e-12;
  std::size_t sources = 0;
  int derivatives = 0;
  bool forbid_single = false;
  // L |g| and L^2 |h| beside |w|, root mean square over sources: the error is relative to the
  // largest of the three. Smaller ones ask less of the windows; a gradient of 0: gradients are in
  // the weights, by gradient_as_weight().
  double gradient_size = 1;
  double hessian_size = 1;
  // Sources that are sure to lie all over the sphere, as the vertices of a closed surface do: many
  // of them near the poles ask less of the windows of Hessians than few. 0: nothing is known.
  std::size_t spread_out = 0;
};
// The cheapest plan by the cost model (docs/performance.md).
NonuniformPlan plan_nonuniform(const NonuniformNeeds& needs);
// Grids that sources are split over, one thread each: as many as pay for the summing of grids,
// whatever the number of threads.
std::size_t grid_count(const NonuniformPlan& plan, std::size_t sources);

}  // namespace rholm
