// Chooses the number of points per cap: small for exact
// points, large for noisy ones (method 7.11). Layer: atlas.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "atlas/cover/ordered_points.h"
#include "rholm/context.h"

namespace rholm {

struct CapSize {
  std::size_t neighbours = 24;
  double noise = 0;         // standard deviation of the points along the caps' normals
  double normal_noise = 0;  // noise of normals against the caps, radians (small angles)
  double gradient_weight = 0.3;
};

CapSize choose_cap_size(const OrderedPoints& points, int degree, const Context& context);

// Returns the minimum of the least-squares parabola of y over x, within the
// range of x. Returns NaN without a minimum, or for fewer than three x.
double least_of_parabola(std::span<const double> x, std::span<const double> y);

// Result of one size, for tests and tuning. A cap is fitted to all points but its seed;
// errors compare its slope with the seed's normal, squared and cut at 1, averaged over seeds.
struct CapSizeTrial {
  std::size_t neighbours = 0;
  double slope_error = 0;
  double rms = 0;        // median of the residuals, in lengths
  double level_rms = 0;  // the same over R_0
  double slope_rms = 0;  // median slope residual on the opened sphere
  double support = 0;    // median support
  double own = 1;        // mean share of nearby points on the seed's sheet
};
CapSizeTrial try_cap_size(const OrderedPoints& points, std::size_t neighbours, int degree,
                          double gradient_weight, std::size_t n_seeds, const Context& context);

}  // namespace rholm
