// The fast transforms at scattered directions: what scattered.cpp and the mesh pass build on.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "harmonic/nonuniform/polar_nodes.h"
#include "harmonic/nonuniform/sphere_fourier.h"
#include "harmonic/nonuniform/spread.h"
#include "rholm/harmonic.h"

namespace rholm {

// Which window, grid and precision a sum of `sources` sources up to degree L gets.
struct NonuniformPlan {
  SphereFourier fourier;
  bool single = false;  // spread and transformed along phi in single precision
  double cost = 0;      // predicted, nanoseconds on the machine the model was measured on
  // Derivatives nearer to a pole are taken from values around them (polar_nodes.h): longitudes
  // there multiply the window's error by 1 / (L sin theta).
  double polar_sine = 0;
};

struct NonuniformNeeds {
  int degree = 0;
  // Wanted relative error of generic sums (random signs, even directions), l2.
  double error = 1e-12;
  std::size_t sources = 0;
  int derivatives = 0;
  bool forbid_single = false;
  // L |g| and L^2 |h| beside |w|, root mean square over sources: the error is relative to the
  // largest of the three. Smaller ones ask less of the windows.
  double gradient_size = 1;
  double hessian_size = 1;
  // Sources that are sure to lie all over the sphere, as the vertices of a closed surface do: many
  // of them near the poles ask less of the windows of Hessians than few. 0: nothing is known.
  std::size_t spread_out = 0;
};
// The cheapest plan by the cost model (docs/performance.md).
NonuniformPlan plan_nonuniform(const NonuniformNeeds& needs);
// The predicted cost of direct sums, in the same unit.
double direct_cost(const NonuniformNeeds& needs);

// How much larger than that of values the plan's error of Hessians is, relative to L^2: for
// `sources` of them all over the sphere.
double hessian_factor(const NonuniformPlan& plan, std::size_t sources);

// What windows in single precision add to the error of generic sums (measured for L = 16 ... 2000,
// up to 2.2e-7 for values and gradients, with windows up to 10 wide).
double single_rounding(int degree, int derivatives = 0);
// Least error that single precision is taken for.
double least_single_error(int degree, int derivatives = 0);

// One grid that batches of sources are added to, in the order of the calls; windows in T.
template <typename T>
class GridSpreader {
 public:
  GridSpreader(const NonuniformPlan& plan, const GridKernel<T>& kernel);
  // The first n sources of the batch, whose positions beyond n are overwritten.
  void add(SourceBatch<T>& batch, std::size_t n, int derivatives);
  // All that was added; no more may be.
  double* grid() { return grid_.data(); }

 private:
  void add_polar(const SourceBatch<T>& batch, const PolarSources& polar, int derivatives);

  const NonuniformPlan& plan_;
  const GridKernel<T>& kernel_;
  AlignedArray<double> grid_;
  std::vector<PolarNode> polar_;  // of the batch in work
};

// Grids that sources are split over, one thread each: as many as pay for the summing of grids,
// whatever the number of threads.
std::size_t grid_count(const NonuniformPlan& plan, std::size_t sources);

// sum += the transform of all grids.
template <typename T>
void finish_adjoint(const NonuniformPlan& plan, std::span<GridSpreader<T>> spreaders,
                    Coefficients& sum, const Context& context, const ParallelStage& stage);

void nonuniform_add_adjoint(const NonuniformPlan& plan, const ScatteredSources& sources,
                            int derivatives, Coefficients& sum, const Context& context);
ValuesAndGradients nonuniform_evaluate(const NonuniformPlan& plan, const Coefficients& coefficients,
                                       std::span<const Vec3> directions, bool with_gradient,
                                       const Context& context);

}  // namespace rholm
