// An adjoint sum over sources that are added in blocks, by either engine.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "harmonic/nonuniform/nonuniform.h"
#include "rholm/harmonic.h"

namespace rholm {

struct AdjointNeeds {
  int degree = 0;
  Engine engine = Engine::kDirect;
  double allowed = 1e-12;   // relative error of generic sums: see NonuniformNeeds
  std::size_t sources = 0;  // approximate number of sources to be added
};

// Adds up w conj(Y) of blocks of sources. The result has the same bits for any number of threads if
// the blocks are the same.
class AdjointBlocks {
 public:
  explicit AdjointBlocks(const AdjointNeeds& needs);
  AdjointBlocks(const AdjointBlocks&) = delete;  // spreaders refer to their plan
  AdjointBlocks& operator=(const AdjointBlocks&) = delete;
  void add(std::span<const Vec3> directions, std::span<const double> weights,
           const Context& context);
  Coefficients finish(const Context& context);

 private:
  Coefficients sum_;
  bool fast_ = false;
  NonuniformPlan plan_;
  GridKernel<double> kernel_;
  std::vector<GridSpreader<double>> spreaders_;  // each takes its part of every block
};

}  // namespace rholm
