#include "transform/rules/error_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rholm {

double degree_factor(const NodeAllowance& allowance, double p) {
  if (allowance.degree == 0 && !allowance.divided) return 1;  // what is asked for is the integral
  const double l = std::max(allowance.degree, 1);
  return allowance.divided ? std::sqrt(1 / (4 * std::numbers::pi * (p - 1))) / l
                           : std::sqrt(1 / (4 * std::numbers::pi * (p + 1))) * (l + 1);
}

double neighbours_in_step(double wave2) {
  if (wave2 >= kInStep * kInStep) return 1;
  return std::min(kMostInStep, kInStep / std::sqrt(wave2));
}

}  // namespace rholm
