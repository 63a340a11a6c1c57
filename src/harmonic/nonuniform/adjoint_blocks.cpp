#include "harmonic/nonuniform/adjoint_blocks.h"

#include <algorithm>

#include "base/parallel.h"
#include "harmonic/legendre/direct_sums.h"
#include "harmonic/nonuniform/cost_model.h"

namespace rholm {

AdjointBlocks::AdjointBlocks(const AdjointNeeds& needs) : sum_(needs.degree) {
  if (needs.engine == Engine::kDirect || needs.sources == 0) return;
  const NonuniformNeeds wanted{.degree = needs.degree,
                               .allowed = std::clamp(needs.allowed, 1e-14, 1e-1),
                               .sources = needs.sources,
                               .forbid_single = true};
  plan_ = plan_nonuniform(wanted);
  fast_ = plan_.cost < direct_cost(wanted.sources, wanted.degree, wanted.derivatives);
  if (!fast_) return;
  kernel_ = grid_kernel<double>(plan_.fourier);
  const std::size_t grids = grid_count(plan_, needs.sources);
  for (std::size_t i = 0; i < grids; ++i) spreaders_.emplace_back(plan_, kernel_);
}

void AdjointBlocks::add(std::span<const Vec3> directions, std::span<const double> weights,
                        const Context& context) {
  if (directions.empty()) return;
  if (!fast_) {
    return direct_add_adjoint({.directions = directions, .weights = weights}, sum_, context);
  }
  const std::size_t n = directions.size(), part = (n + spreaders_.size() - 1) / spreaders_.size();
  parallel_for(n, part, context, {"transform", 0, 1}, [&](std::size_t begin, std::size_t end) {
    auto batch = std::make_unique<SourceBatch<double>>();
    constexpr std::size_t kSize = SourceBatch<double>::kSize;
    for (std::size_t first = begin; first < end; first += kSize) {
      const std::size_t count = std::min(kSize, end - first);
      for (std::size_t j = 0; j < count; ++j) {
        batch->x[0][j] = directions[first + j].x;
        batch->x[1][j] = directions[first + j].y;
        batch->x[2][j] = directions[first + j].z;
        batch->value[j] = weights[first + j];
      }
      spreaders_[begin / part].add(*batch, count, 0);
    }
  });
}

Coefficients AdjointBlocks::finish(const Context& context) {
  if (fast_) {
    finish_adjoint<double>(plan_, spreaders_, sum_, context, {"transform", 0, 1});
  }
  return std::move(sum_);
}

}  // namespace rholm
