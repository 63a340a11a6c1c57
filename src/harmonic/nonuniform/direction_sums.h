// The sums of evaluate() of one function, for who asks for them again and again.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "harmonic/nonuniform/grid_function.h"
#include "harmonic/nonuniform/nonuniform_plan.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/harmonic.h"

namespace rholm {

class DirectionSums {
 public:
  // By whichever engine is cheaper for about so many directions in all, with gradients or without.
  DirectionSums(const Coefficients& coefficients, std::size_t directions, bool with_gradient,
                const SumOptions& options, const Context& context);
  DirectionSums(const DirectionSums&) = delete;
  DirectionSums& operator=(const DirectionSums&) = delete;

  // Values, and gradients if wanted, which they may be only if they were.
  ValuesAndGradients at(std::span<const Vec3> directions, bool with_gradient,
                        const Context& context) const;

 private:
  std::optional<Coefficients> direct_;  // where there is no grid
  std::optional<NonuniformPlan> plan_;
  std::optional<GridFunction<float>> single_;
  std::optional<GridFunction<double>> double_;
};

}  // namespace rholm
