#include "transform/rules/error_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rholm {
namespace {
// Elements this many times as long as wide may belong to a fan. Then they count up to kFan times
// (chosen; as in a fan of 160 triangles that are as long as a tenth of a wave).
constexpr double kNarrow = 2, kFan = 7;
}  // namespace

double degree_factor(const NodeAllowance& allowance, double p) {
  if (allowance.degree == 0 && !allowance.divided) return 1;  // the integral itself is wanted
  const double l = std::max(allowance.degree, 1);
  return allowance.divided ? std::sqrt(1 / (4 * std::numbers::pi * (p - 1))) / l
                           : std::sqrt(1 / (4 * std::numbers::pi * (p + 1))) * (l + 1);
}

double neighbours_in_step(double wave2) {
  if (wave2 >= kInStep * kInStep) return 1;
  return std::min(kMostInStep, kInStep / std::sqrt(wave2));
}

double crowd_in_step2(double along, double across) {
  if (across <= along) return along * along;
  const double fan = std::clamp(across / (kNarrow * along), 1.0, kFan);
  return std::min(kMostInStep * kMostInStep, along * across * fan);
}

}  // namespace rholm
