#include "transform/degree_bracket.h"

#include <algorithm>
#include <cmath>

namespace rholm {

void DegreeBracket::add(int degree, double value, double limit) {
  const bool is_good = value <= limit;
  same_side = is_good == (same_side > 0) ? same_side + (is_good ? 1 : -1) : (is_good ? 1 : -1);
  (is_good ? good : bad) = degree;
  (is_good ? good_value : bad_value) = value;
}

int DegreeBracket::guess(double limit) const {
  const double from = std::log(std::max(bad, 0) + 1.0), to = std::log(good + 1.0);
  double t = 0.5;
  if (at_vertices && std::abs(same_side) < 3) {
    // From what was tried last.
    const bool by_good = same_side >= 0 && good_value > 0;
    const double at =
        by_good ? to + std::log(good_value / limit) : from + std::log(bad_value / limit);
    t = (at - from) / (to - from);
  } else if (bad >= 0 && good_value > 0 && std::abs(same_side) < 2) {
    t = std::log(bad_value / limit) / std::log(bad_value / good_value);
  }
  if (!std::isfinite(t)) t = 0.5;
  const double degree = std::exp(from + std::clamp(t, 0.0, 1.0) * (to - from)) - 1;
  const int low = bad + step(), high = good - step();
  if (low > high) return std::max(bad + 1, (bad + good) / 2);
  return std::clamp(static_cast<int>(std::ceil(degree)), low, high);
}

}  // namespace rholm
