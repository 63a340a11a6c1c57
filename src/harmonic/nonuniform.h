// The fast transforms at scattered directions: what scattered.cpp and the mesh pass build on.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "harmonic/polar_nodes.h"
#include "harmonic/sphere_fourier.h"
#include "harmonic/spread.h"
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
  // In single precision: additions to a cell after which the error may have grown to a fifth of
  // what is wanted.
  double most_additions = 0;
};

// Relative error of a sum in single precision per addition (measured on regular meshes, where it
// grows with the number, not with its root).
inline constexpr double kDriftPerAddition = 5e-9;

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
};
// The cheapest plan by the cost model (docs/performance.md).
NonuniformPlan plan_nonuniform(const NonuniformNeeds& needs);
// The predicted cost of direct sums, in the same unit.
double direct_cost(const NonuniformNeeds& needs);

// What single precision adds to the error of generic sums: rounding of directions to 24 bits,
// which grows with the degree, and of windows (measured for L = 16 ... 800).
double single_rounding(int degree, int derivatives = 0);
// Least error that single precision is taken for.
double least_single_error(int degree, int derivatives = 0);

// One grid that batches of sources are added to, in the order of the calls.
template <typename T>
class GridSpreader {
 public:
  GridSpreader(const NonuniformPlan& plan, const GridKernel<T>& kernel);
  // The first n sources of the batch, whose positions beyond n are overwritten.
  void add(SourceBatch<T>& batch, std::size_t n, int derivatives);
  // All that was added; no more may be.
  T* grid();

 private:
  void add_polar(const SourceBatch<T>& batch, const PolarSources& polar, int derivatives);

  void set_aside();

  const NonuniformPlan& plan_;
  const GridKernel<T>& kernel_;
  AlignedArray<T> grid_;
  // In single precision sums of very many terms drift: the grid is emptied into this one in time.
  AlignedArray<double> total_;
  double additions_ = 0;          // to a cell, on average, since then
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
