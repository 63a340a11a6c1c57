// A function of direction on the grid of a plan, which is read at many directions in batches.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "harmonic/nonuniform/nonuniform_plan.h"
#include "harmonic/nonuniform/spread.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"

namespace rholm {

// Fills the lanes without a source; any direction is allowed there.
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
  // Keeps a reference to the plan.
  GridFunction(const NonuniformPlan& plan, const Coefficients& coefficients,
               const Context& context);

  // Batches hold the function and its gradient times this factor. It is a power of two that brings
  // the largest coefficient to 1 ... 2, because single precision ends at 1e38.
  double scale() const { return scale_; }
  // Reads values at the first n positions of the batch and, on request, gradients. Call
  // polar_gradient() for the gradients of positions listed in `near`, which are close to a pole.
  // Overwrites positions beyond n. Thread-safe for separate batches.
  void read(SourceBatch<T>& batch, std::size_t n, bool with_gradient, PolarSources& near) const;
  // Returns the gradient next to a pole; overwrites the batch.
  Vec3 polar_gradient(const Vec3& u, SourceBatch<T>& batch) const;

 private:
  const NonuniformPlan& plan_;
  GridKernel<T> kernel_;
  AlignedArray<T> grid_;
  double scale_ = 1;
};

}  // namespace rholm
