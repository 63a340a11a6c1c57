// An adjoint sum over sources that come block by block, by either engine.
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
  double allowed = 1e-12;   // to be left of generic sums, relative: see NonuniformNeeds
  std::size_t sources = 0;  // about how many will come
};

// Adds up w conj(Y) of blocks of sources; the same bits for any number of threads, if blocks are
// cut alike.
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
