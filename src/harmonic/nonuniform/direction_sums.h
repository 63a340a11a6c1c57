// The sums of evaluate() of one function, for repeated evaluation.
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
  // Takes the cheaper engine for about `directions` directions, with or without gradients.
  DirectionSums(const Coefficients& coefficients, std::size_t directions, bool with_gradient,
                const SumOptions& options, const Context& context);
  DirectionSums(const DirectionSums&) = delete;
  DirectionSums& operator=(const DirectionSums&) = delete;

  // Returns values and, on request, gradients; these require `with_gradient` at construction.
  ValuesAndGradients at(std::span<const Vec3> directions, bool with_gradient,
                        const Context& context) const;

 private:
  std::optional<Coefficients> direct_;  // set if there is no grid
  std::optional<NonuniformPlan> plan_;
  std::optional<GridFunction<float>> single_;
  std::optional<GridFunction<double>> double_;
};

}  // namespace rholm
