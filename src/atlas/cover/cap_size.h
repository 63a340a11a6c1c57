// How many points a cap should have: few where they are exact, many where they are noisy (method
// 7.11). Layer: atlas.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "atlas/cover/ordered_points.h"
#include "rholm/context.h"

namespace rholm {

struct CapSize {
  std::size_t neighbours = 24;
  double noise = 0;         // standard deviation of the points along the normals of the caps
  double normal_noise = 0;  // of the normals against the caps, radians (small angles)
  double gradient_weight = 0.3;
};

CapSize choose_cap_size(const OrderedPoints& points, int degree, const Context& context);

// Where the parabola of least squares through y over x is least, within the range of x; NaN if it
// has no least value, or there are fewer than three x.
double least_of_parabola(std::span<const double> x, std::span<const double> y);

// Of one size, for tests and tuning: mean over seeds of the squared slope between a seed's normal
// and the cap fitted to all but the seed, cut at 1, and medians of the residuals.
struct CapSizeTrial {
  std::size_t neighbours = 0;
  double slope_error = 0;
  double rms = 0;        // median of the residuals, in lengths
  double level_rms = 0;  // the same over R_0
  double slope_rms = 0;  // on the opened sphere
  double support = 0;    // median
  double own = 1;        // mean share of the points around that are on the seed's sheet
};
CapSizeTrial try_cap_size(const OrderedPoints& points, std::size_t neighbours, int degree,
                          double gradient_weight, std::size_t n_seeds, const Context& context);

}  // namespace rholm
