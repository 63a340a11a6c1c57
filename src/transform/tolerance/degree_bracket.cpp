#include "transform/tolerance/degree_bracket.h"

#include <algorithm>
#include <cmath>

namespace rholm {

void DegreeBracket::add(int degree, double value, double limit) {
  const bool is_good = value <= limit;
  same_side = is_good == (same_side > 0) ? same_side + (is_good ? 1 : -1) : (is_good ? 1 : -1);
  before = is_good ? good : bad;
  before_value = is_good ? good_value : bad_value;
  (is_good ? good : bad) = degree;
  (is_good ? good_value : bad_value) = value;
}

// Guesses by the power of the degree that both ends follow. If the last guesses were on one side,
// it uses the power that these guesses follow; if that goes on, it halves.
int DegreeBracket::guess(double limit) const {
  const double from = std::log(std::max(bad, 0) + 1.0), to = std::log(good + 1.0);
  double at = (from + to) / 2;
  const double power = std::log(bad_value / good_value) / (to - from);
  if (std::abs(same_side) < 2) {
    if (bad >= 0 && std::isfinite(power)) at = from + std::log(bad_value / limit) / power;
  } else if (std::abs(same_side) < 4 && before >= 0 && before_value > 0) {
    const double last = same_side > 0 ? to : from;
    const double last_value = same_side > 0 ? good_value : bad_value;
    const double local = std::log(before_value / last_value) / (last - std::log(before + 1.0));
    if (local > 0 && std::isfinite(local)) at = last + std::log(last_value / limit) / local;
  }
  if (!std::isfinite(at)) at = (from + to) / 2;
  const double degree = std::exp(std::clamp(at, from, to)) - 1;
  const int low = bad + step(), high = good - step();
  if (low > high) return std::max(bad + 1, (bad + good) / 2);
  return std::clamp(static_cast<int>(std::ceil(degree)), low, high);
}

}  // namespace rholm
