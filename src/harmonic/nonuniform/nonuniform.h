// The fast transforms at scattered directions: what scattered.cpp and the mesh pass build on.
#pragma once

#include <cstddef>
#include <vector>

#include "harmonic/nonuniform/grid_function.h"
#include "harmonic/nonuniform/nonuniform_plan.h"
#include "harmonic/nonuniform/polar_nodes.h"
#include "harmonic/nonuniform/spread.h"
#include "rholm/harmonic.h"

namespace rholm {

// One grid that batches of sources are added to, in the order of the calls; windows in T.
template <typename T>
class GridSpreader {
 public:
  GridSpreader(const NonuniformPlan& plan, const GridKernel<T>& kernel);
  // The first n sources of the batch, whose positions beyond n are overwritten.
  void add(SourceBatch<T>& batch, std::size_t n, int derivatives);
  // All that was added; no more may be.
  double* grid() { return grid_.data(); }
  std::size_t n_cells() const { return plan_.fourier.layout.cells(); }

 private:
  void add_polar(const SourceBatch<T>& batch, const PolarSources& polar, int derivatives);

  const NonuniformPlan& plan_;
  const GridKernel<T>& kernel_;
  AlignedArray<double> grid_;
  std::vector<PolarNode> polar_;  // of the batch in work
};

// sum += the transform of all grids.
template <typename T>
void finish_adjoint(const NonuniformPlan& plan, std::span<GridSpreader<T>> spreaders,
                    Coefficients& sum, const Context& context, const ParallelStage& stage);

void nonuniform_add_adjoint(const NonuniformPlan& plan, const ScatteredSources& sources,
                            int derivatives, Coefficients& sum, const Context& context);
// Of two kinds in one grid: those without derivatives cost less.
void nonuniform_add_adjoint(const NonuniformPlan& plan, const ScatteredSources& values,
                            const ScatteredSources& hessians, Coefficients& sum,
                            const Context& context);
// The function at directions; gradients on request.
template <typename T>
ValuesAndGradients read_at(const GridFunction<T>& function, std::span<const Vec3> directions,
                           bool with_gradient, const Context& context);

}  // namespace rholm
