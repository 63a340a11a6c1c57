// The fast transforms at scattered directions, on which scattered.cpp and the mesh pass build.
#pragma once

#include <cstddef>
#include <vector>

#include "harmonic/nonuniform/grid_function.h"
#include "harmonic/nonuniform/nonuniform_plan.h"
#include "harmonic/nonuniform/polar_nodes.h"
#include "harmonic/nonuniform/spread.h"
#include "rholm/harmonic.h"

namespace rholm {

// A grid to which batches of sources are added, in the order of the calls; windows are in T.
template <typename T>
class GridSpreader {
 public:
  GridSpreader(const NonuniformPlan& plan, const GridKernel<T>& kernel);
  // Adds the first n sources of the batch; overwrites its positions beyond n.
  void add(SourceBatch<T>& batch, std::size_t n, int derivatives);
  // Returns the sum of all sources; nothing may be added afterwards.
  double* grid() { return grid_.data(); }
  std::size_t n_cells() const { return plan_.fourier.layout.cells(); }

 private:
  void add_polar(const SourceBatch<T>& batch, const PolarSources& polar, int derivatives);

  const NonuniformPlan& plan_;
  const GridKernel<T>& kernel_;
  AlignedArray<double> grid_;
  std::vector<PolarNode> polar_;  // nodes of the current batch
};

// Adds the transform of all grids to `sum`.
template <typename T>
void finish_adjoint(const NonuniformPlan& plan, std::span<GridSpreader<T>> spreaders,
                    Coefficients& sum, const Context& context, const ParallelStage& stage);

void nonuniform_add_adjoint(const NonuniformPlan& plan, const ScatteredSources& sources,
                            int derivatives, Coefficients& sum, const Context& context);
// Adds sources of two kinds to one grid; sources without derivatives cost less.
void nonuniform_add_adjoint(const NonuniformPlan& plan, const ScatteredSources& values,
                            const ScatteredSources& hessians, Coefficients& sum,
                            const Context& context);
// Returns the values of the function at directions and, on request, its gradients.
template <typename T>
ValuesAndGradients read_at(const GridFunction<T>& function, std::span<const Vec3> directions,
                           bool with_gradient, const Context& context);

}  // namespace rholm
