// Covers points with caps, each fitted by least squares (method 7.4). Layer: atlas.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "atlas/cover/ordered_points.h"
#include "rholm/atlas.h"
#include "rholm/context.h"

namespace rholm {

struct CoverOptions {
  std::size_t neighbours = 24;  // points per cap, on even points; fewer where the fit is bad
  int degree = 3;
  double noise = 0;  // standard deviation of the points along their normals
  double gradient_weight = 0.3;
  double tolerance = 0;  // caps grow while residuals are below it; 0: no growth
  double core = 0.5;     // points within this part of the support need no own cap
  // One flag per point, in the order of the tree, or empty.
  // Flagged points are covered elsewhere and need no cap.
  std::span<const std::uint8_t> foreign = {};
};

struct Cover {
  std::vector<Cap> caps;
  std::vector<double> coefficients;
  // Points (in the order of the tree) that no cap fits: outliers, or places with too few points.
  std::vector<std::uint32_t> rejected;
};
Cover cover(const OrderedPoints& points, const CoverOptions& options, const Context& context);

}  // namespace rholm
