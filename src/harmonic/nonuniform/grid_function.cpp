#include "harmonic/nonuniform/grid_function.h"

#include <array>
#include <type_traits>
#include <vector>

#include "harmonic/nonuniform/polar_nodes.h"
#include "harmonic/nonuniform/scale_for.h"

namespace rholm {

template <typename T>
GridFunction<T>::GridFunction(const NonuniformPlan& plan, const Coefficients& coefficients,
                              const Context& context)
    : plan_(plan), kernel_(grid_kernel<T>(plan.fourier)), grid_(plan.fourier.layout.cells()) {
  const ParallelStage stage = {"transform", 0, 0.4};
  if constexpr (std::is_same_v<T, float>) {
    double largest = 0;
    for (const double c : coefficients.values()) largest = std::max(largest, std::abs(c));
    scale_ = scale_for(largest);
    Coefficients scaled = coefficients;
    for (double& c : scaled.values()) c *= scale_;
    coefficients_to_grid(plan.fourier, scaled, grid_.data(), context, stage);
  } else {
    coefficients_to_grid(plan.fourier, coefficients, grid_.data(), context, stage);
  }
}

template <typename T>
void GridFunction<T>::read(SourceBatch<T>& batch, std::size_t n, bool with_gradient,
                           PolarSources& near) const {
  pad(batch, n);
  interpolate(kernel_, grid_.data(), n, with_gradient ? 1 : 0, plan_.polar_sine, batch, near);
}

template <typename T>
Vec3 GridFunction<T>::polar_gradient(const Vec3& u, SourceBatch<T>& batch) const {
  const double step = difference_step<T>(plan_.fourier.degree);
  const std::array<Vec3, 2> axes = tangents(u);
  std::vector<PolarNode> nodes;
  for (const Vec3& axis : axes) {
    // Half of these nodes are along the other axis and have weight 0.
    add_gradient_nodes(u, axis, step, nodes);
  }
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    batch.x[0][k] = nodes[k].u.x;
    batch.x[1][k] = nodes[k].u.y;
    batch.x[2][k] = nodes[k].u.z;
  }
  PolarSources none;
  pad(batch, nodes.size());
  interpolate(kernel_, grid_.data(), nodes.size(), 0, 0, batch, none);
  std::array<double, 2> slopes = {};
  const std::size_t half = nodes.size() / 2;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    slopes[k / half] += nodes[k].weight * batch.value[k];
  }
  return slopes[0] * axes[0] + slopes[1] * axes[1];
}

template class GridFunction<float>;
template class GridFunction<double>;

}  // namespace rholm
