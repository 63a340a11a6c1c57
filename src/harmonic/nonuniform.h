// The fast transforms at scattered directions: what scattered.cpp and the mesh pass build on.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "harmonic/sphere_fourier.h"
#include "harmonic/spread.h"
#include "rholm/harmonic.h"

namespace rholm {

// Which window, grid and precision a sum of `sources` sources up to degree L gets.
struct NonuniformPlan {
  SphereFourier fourier;
  bool single = false;  // spread and transformed along phi in single precision
  double cost = 0;      // predicted, nanoseconds on the machine the model was measured on
  // Sources with derivatives nearer to a pole are to be summed directly: longitudes there multiply
  // the window's error by 1 / (L sin theta).
  double polar_sine = 0;
};

struct NonuniformNeeds {
  int degree = 0;
  // Wanted relative error of generic sums (random signs, even directions), l2.
  double error = 1e-12;
  std::size_t sources = 0;
  int derivatives = 0;
  bool forbid_single = false;
};
// The cheapest plan by the cost model (docs/performance.md).
NonuniformPlan plan_nonuniform(const NonuniformNeeds& needs);
// The predicted cost of direct sums, in the same unit.
double direct_cost(const NonuniformNeeds& needs);

// Least error that single precision is good for: rounding of directions and of the window's values
// leaves 2e-7 of generic sums (measured), three times that is kept as a margin.
inline constexpr double kLeastSingleError = 6e-7;

// Sources that are summed directly at the end.
struct DirectList {
  std::vector<Vec3> directions;
  std::vector<double> weights;
  std::vector<Vec3> gradients;
  std::vector<std::array<double, 6>> hessians;

  ScatteredSources view() const { return {directions, weights, gradients, hessians}; }
  void append(const DirectList& other);
};

// One grid that batches of sources are added to, in the order of the calls.
template <typename T>
class GridSpreader {
 public:
  GridSpreader(const NonuniformPlan& plan, const GridKernel<T>& kernel);
  // The first n sources of the batch, whose positions beyond n are overwritten.
  void add(SourceBatch<T>& batch, std::size_t n, int derivatives);
  T* grid() { return grid_.data(); }
  const DirectList& polar() const { return polar_; }

 private:
  const NonuniformPlan& plan_;
  const GridKernel<T>& kernel_;
  AlignedArray<T> grid_;
  DirectList polar_;
};

// Grids that sources are split over, one thread each: as many as pay for the summing of grids,
// whatever the number of threads.
std::size_t grid_count(const NonuniformPlan& plan, std::size_t sources);

// sum += the transform of all grids and of the polar sources.
template <typename T>
void finish_adjoint(const NonuniformPlan& plan, std::span<GridSpreader<T>> spreaders,
                    Coefficients& sum, const Context& context, const ParallelStage& stage);

void nonuniform_add_adjoint(const NonuniformPlan& plan, const ScatteredSources& sources,
                            int derivatives, Coefficients& sum, const Context& context);
ValuesAndGradients nonuniform_evaluate(const NonuniformPlan& plan, const Coefficients& coefficients,
                                       std::span<const Vec3> directions, bool with_gradient,
                                       const Context& context);

}  // namespace rholm
