// The largest radial error over the whole surface: method 5.
#pragma once

#include <cstddef>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "transform/error/error_peaks.h"
#include "transform/error/error_points.h"
#include "transform/error/error_sites.h"
#include "transform/error/radial_model.h"

namespace rholm {

struct LargestRadial {
  double value = 0;
  Peaks peaks;           // where climbs ended
  std::size_t seen = 0;  // number of points examined between the known points

  // Returns the points of the highest peaks, apart from each other by waves of the degree.
  ErrorPoints worst(int degree) const;
};
// `model` has all degrees of the expansion. `known` are points with radial errors `values`, among
// them the worst vertices and extreme_points(). Where faces are long against 1/L, points between
// these are examined. `rms` is about the root mean square of all radial errors.
LargestRadial largest_radial(const Expansion& expansion, const RadialModel& model,
                             const ErrorPoints& known, const std::vector<double>& values,
                             double rms, ErrorSites& sites, const Context& context);

}  // namespace rholm
