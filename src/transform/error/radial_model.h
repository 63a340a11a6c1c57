// The first degrees of an expansion, for measurements at many points.
#pragma once

#include <cstddef>

#include "harmonic/nonuniform/direction_sums.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"

namespace rholm {

struct RadialModel {
  // Suits about `directions` directions, with gradients if `slopes`; `precision` as in SumOptions.
  RadialModel(const Expansion& expansion, int cut, std::size_t directions, bool slopes,
              double precision, const Context& context)
      : degree(cut),
        is_gauge(expansion.function == RadialFunction::kGauge),
        sums(expansion.coefficients.resized(cut), directions, slopes, {.precision = precision},
             context) {}

  int degree;
  bool is_gauge;  // the function is 1/r
  DirectionSums sums;
};

}  // namespace rholm
