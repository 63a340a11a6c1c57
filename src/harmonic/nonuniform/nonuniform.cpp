#include "harmonic/nonuniform/nonuniform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/resize_asking.h"
#include "harmonic/nonuniform/grid_function.h"
#include "harmonic/nonuniform/scale_for.h"

namespace rholm {
namespace {

double largest_of(const ScatteredSources& sources) {
  double largest = 0;
  for (const double w : sources.weights) largest = std::max(largest, std::abs(w));
  for (const Vec3& g : sources.gradients) {
    largest = std::max({largest, std::abs(g.x), std::abs(g.y), std::abs(g.z)});
  }
  for (const auto& hessian : sources.hessians) {
    for (const double h : hessian) largest = std::max(largest, std::abs(h));
  }
  return largest;
}

template <typename T>
void load_positions(std::span<const Vec3> directions, SourceBatch<T>& batch) {
  for (std::size_t j = 0; j < directions.size(); ++j) {
    batch.x[0][j] = directions[j].x;
    batch.x[1][j] = directions[j].y;
    batch.x[2][j] = directions[j].z;
  }
}

template <typename T>
void load_sources(const ScatteredSources& sources, std::size_t first, std::size_t n,
                  int derivatives, double scale, SourceBatch<T>& batch) {
  load_positions(sources.directions.subspan(first, n), batch);
  pad(batch, n);
  for (std::size_t j = 0; j < n; ++j) {
    batch.value[j] =
        sources.weights.empty() ? T{0} : static_cast<T>(scale * sources.weights[first + j]);
    if (derivatives == 0) continue;
    const Vec3 g = sources.gradients.empty() ? Vec3{} : scale * sources.gradients[first + j];
    batch.gradient[0][j] = static_cast<T>(g.x);
    batch.gradient[1][j] = static_cast<T>(g.y);
    batch.gradient[2][j] = static_cast<T>(g.z);
    if (derivatives == 1) continue;
    for (int i = 0; i < 6; ++i)
      batch.hessian[i][j] = static_cast<T>(scale * sources.hessians[first + j][i]);
  }
}

// Sources, and the number of their derivatives that is used.
struct SourceKind {
  const ScatteredSources& sources;
  int derivatives;
};

template <typename T>
void add_sources(const NonuniformPlan& plan, std::span<const SourceKind> kinds, double scale,
                 Coefficients& sum, const Context& context) {
  const GridKernel<T> kernel = grid_kernel<T>(plan.fourier);
  std::size_t all = 0;
  for (const SourceKind& kind : kinds) all += kind.sources.directions.size();
  const std::size_t parts = grid_count(plan, all);
  std::vector<GridSpreader<T>> spreaders;
  spreaders.reserve(parts);
  for (std::size_t part = 0; part < parts; ++part) spreaders.emplace_back(plan, kernel);
  for (const auto& [sources, derivatives] : kinds) {
    const std::size_t n = sources.directions.size(), size = (n + parts - 1) / parts;
    parallel_for(n, size, context, {"spread", 0, 0.6}, [&](std::size_t begin, std::size_t end) {
      auto batch = std::make_unique<SourceBatch<T>>();
      constexpr std::size_t kSize = SourceBatch<T>::kSize;
      for (std::size_t first = begin; first < end; first += kSize) {
        const std::size_t count = std::min(kSize, end - first);
        load_sources(sources, first, count, derivatives, scale, *batch);
        spreaders[begin / size].add(*batch, count, derivatives);
      }
    });
  }
  finish_adjoint<T>(plan, spreaders, sum, context, {"transform", 0.6, 1});
}

void add_kinds(const NonuniformPlan& plan, std::span<const SourceKind> kinds, Coefficients& sum,
               const Context& context) {
  if (!plan.single) return add_sources<double>(plan, kinds, 1, sum, context);
  double largest = 0;
  for (const SourceKind& kind : kinds) largest = std::max(largest, largest_of(kind.sources));
  const double scale = scale_for(largest);
  Coefficients scaled(sum.degree());
  add_sources<float>(plan, kinds, scale, scaled, context);
  for (std::size_t i = 0; i < sum.values().size(); ++i) {
    sum.values()[i] += scaled.values()[i] / scale;
  }
}

}  // namespace

template <typename T>
GridSpreader<T>::GridSpreader(const NonuniformPlan& plan, const GridKernel<T>& kernel)
    : plan_(plan),
      kernel_(kernel),
      grid_(AlignedArray<double>::zeros(plan.fourier.layout.cells())) {}

template <typename T>
void GridSpreader<T>::add(SourceBatch<T>& batch, std::size_t n, int derivatives) {
  pad(batch, n);
  PolarSources polar;
  spread(kernel_, batch, n, derivatives, plan_.polar_sine, grid_.data(), polar);
  if (polar.count > 0) add_polar(batch, polar, derivatives);
}

template <typename T>
void GridSpreader<T>::add_polar(const SourceBatch<T>& batch, const PolarSources& polar,
                                int derivatives) {
  const double step = difference_step<T>(plan_.fourier.degree);
  auto values = std::make_unique<SourceBatch<T>>();
  for (std::size_t i = 0; i < polar.count; ++i) {
    const std::uint32_t j = polar.index[i];
    const Vec3 x = {batch.x[0][j], batch.x[1][j], batch.x[2][j]};
    // Derivatives of a function of direction alone are inversely proportional to the distance.
    const double r = norm(x);
    const Vec3 u = x / r;
    polar_.clear();
    polar_.push_back({u, batch.value[j]});
    add_gradient_nodes(u,
                       Vec3{batch.gradient[0][j], batch.gradient[1][j], batch.gradient[2][j]} / r,
                       step, polar_);
    if (derivatives > 1) {
      std::array<double, 6> h;
      for (int k = 0; k < 6; ++k) h[k] = batch.hessian[k][j] / (r * r);
      add_hessian_nodes(u, h, step, polar_);
    }
    std::size_t n = 0;
    for (const PolarNode& node : polar_) {
      values->x[0][n] = node.u.x;
      values->x[1][n] = node.u.y;
      values->x[2][n] = node.u.z;
      values->value[n++] = static_cast<T>(node.weight);
    }
    add(*values, n, 0);
  }
}

template <typename T>
void finish_adjoint(const NonuniformPlan& plan, std::span<GridSpreader<T>> spreaders,
                    Coefficients& sum, const Context& context, const ParallelStage& stage) {
  std::vector<double*> grids;
  for (GridSpreader<T>& spreader : spreaders) grids.push_back(spreader.grid());
  grid_to_coefficients(plan.fourier, grids, sum, context, stage);
}

template class GridSpreader<float>;
template class GridSpreader<double>;
template void finish_adjoint(const NonuniformPlan&, std::span<GridSpreader<float>>, Coefficients&,
                             const Context&, const ParallelStage&);
template void finish_adjoint(const NonuniformPlan&, std::span<GridSpreader<double>>, Coefficients&,
                             const Context&, const ParallelStage&);

void nonuniform_add_adjoint(const NonuniformPlan& plan, const ScatteredSources& sources,
                            int derivatives, Coefficients& sum, const Context& context) {
  const SourceKind kinds[] = {{sources, derivatives}};
  add_kinds(plan, kinds, sum, context);
}

void nonuniform_add_adjoint(const NonuniformPlan& plan, const ScatteredSources& values,
                            const ScatteredSources& hessians, Coefficients& sum,
                            const Context& context) {
  const SourceKind kinds[] = {{values, 0}, {hessians, 2}};
  add_kinds(plan, kinds, sum, context);
}

template <typename T>
ValuesAndGradients read_at(const GridFunction<T>& function, std::span<const Vec3> directions,
                           bool with_gradient, const Context& context) {
  const double scale = function.scale();
  ValuesAndGradients result;
  resize_asking(result.values, directions.size());
  if (with_gradient) resize_asking(result.gradients, directions.size());
  constexpr std::size_t kSize = SourceBatch<T>::kSize;
  constexpr std::size_t kBatches = 16;  // chosen: tasks of about 100 us
  const std::size_t grain = kBatches * kSize;
  parallel_for(directions.size(), grain, context, {"interpolate", 0.4, 1},
               [&](std::size_t begin, std::size_t end) {
                 auto batch = std::make_unique<SourceBatch<T>>();
                 PolarSources near;
                 for (std::size_t first = begin; first < end; first += kSize) {
                   const std::size_t n = std::min(kSize, end - first);
                   load_positions(directions.subspan(first, n), *batch);
                   function.read(*batch, n, with_gradient, near);
                   for (std::size_t j = 0; j < n; ++j) {
                     result.values[first + j] = batch->value[j] / scale;
                     if (!with_gradient) continue;
                     const Vec3 gradient = {batch->gradient[0][j], batch->gradient[1][j],
                                            batch->gradient[2][j]};
                     result.gradients[first + j] = gradient / scale;
                   }
                   for (std::size_t i = 0; i < near.count; ++i) {
                     const std::size_t j = first + near.index[i];
                     result.gradients[j] = function.polar_gradient(directions[j], *batch) / scale;
                   }
                 }
               });
  return result;
}

template ValuesAndGradients read_at(const GridFunction<float>&, std::span<const Vec3>, bool,
                                    const Context&);
template ValuesAndGradients read_at(const GridFunction<double>&, std::span<const Vec3>, bool,
                                    const Context&);

}  // namespace rholm
