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
  std::size_t seen = 0;  // points between the known ones that were looked at

  // Of the highest peaks, apart from each other by waves of the degree.
  ErrorPoints worst(int degree) const;
};
// `model`: all degrees of the expansion. `known`: points with their radial errors `values`, among
// them the worst of the vertices and of extreme_points(); between these the surface is looked at
// where faces are long against 1/L. `rms`: the root mean square of all radial errors, about.
LargestRadial largest_radial(const Expansion& expansion, const RadialModel& model,
                             const ErrorPoints& known, const std::vector<double>& values,
                             double rms, ErrorSites& sites, const Context& context);

}  // namespace rholm
