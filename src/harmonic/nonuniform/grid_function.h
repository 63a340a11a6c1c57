// A function of direction on the grid of a plan, to be read at many directions in batches.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "harmonic/nonuniform/nonuniform_plan.h"
#include "harmonic/nonuniform/spread.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"

namespace rholm {

// A lane without a source: any direction will do.
template <typename T>
void pad(SourceBatch<T>& batch, std::size_t n) {
  constexpr std::size_t kLanes = 16;
  for (std::size_t j = n; j < std::min((n + kLanes - 1) / kLanes * kLanes, SourceBatch<T>::kSize);
       ++j) {
    batch.x[0][j] = 1;
    batch.x[1][j] = batch.x[2][j] = 0;
    batch.value[j] = 0;
  }
}

template <typename T>
class GridFunction {
 public:
  // The plan must outlive it.
  GridFunction(const NonuniformPlan& plan, const Coefficients& coefficients,
               const Context& context);

  // What batches hold is this many times the function and its gradient: a power of two that
  // brings the largest coefficient to 1 ... 2 for single precision, which ends at 1e38.
  double scale() const { return scale_; }
  // Values at the first n positions of the batch, on request gradients too; of those listed as
  // `near` a pole, gradients are to be asked of polar_gradient(). Positions beyond n are
  // overwritten. By any number of threads, each with a batch of its own.
  void read(SourceBatch<T>& batch, std::size_t n, bool with_gradient, PolarSources& near) const;
  // Overwrites the batch.
  Vec3 polar_gradient(const Vec3& u, SourceBatch<T>& batch) const;

 private:
  const NonuniformPlan& plan_;
  GridKernel<T> kernel_;
  AlignedArray<T> grid_;
  double scale_ = 1;
};

}  // namespace rholm
