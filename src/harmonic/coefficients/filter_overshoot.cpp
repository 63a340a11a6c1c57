// A filtered step, sum of g_l a_l P_l(cos theta), searched for its largest and smallest value.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "rholm/error.h"
#include "rholm/filter.h"

namespace rholm {
namespace {

constexpr double kEdge = 0.5;  // cos of 60 degrees

// Points per half wave of the highest degree: the parabola through three of them then has the
// height of an extremum within a part in a thousand.
constexpr int kPointsPerHalfWave = 16;

// Below this values are rounding.
constexpr double kNothing = 1e-12;

// a_0 = (1 - x)/2 and a_l = (P_{l-1}(x) - P_{l+1}(x))/2 at the edge, times the gains.
std::vector<double> filtered_step(std::span<const double> gains) {
  std::vector<double> series(gains.size());
  double before = 1, here = 1, after = kEdge;  // P_{l-1}, P_l, P_{l+1}
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const double l = static_cast<double>(i);
    series[i] = gains[i] * (i == 0 ? 1 - kEdge : before - after) / 2;
    before = here;
    here = after;
    after = ((2 * l + 3) * kEdge * here - (l + 1) * before) / (l + 2);
  }
  return series;
}

// Clenshaw's sum, with (l+1) P_{l+1} = (2l+1) x P_l - l P_{l-1}.
double sum_at(std::span<const double> series, double x) {
  double b1 = 0, b2 = 0;
  for (std::size_t i = series.size(); i-- > 0;) {
    const double l = static_cast<double>(i);
    const double b = series[i] + (2 * l + 1) / (l + 1) * x * b1 - (l + 1) / (l + 2) * b2;
    b2 = b1;
    b1 = b;
  }
  return b1;
}

// The largest value of the parabola through three equidistant ones, where it is in between.
double crest(double left, double middle, double right) {
  const double slope = right - left, bend = 2 * middle - left - right;
  const bool inside = bend > 0 && std::abs(slope) <= 2 * bend;
  return inside ? middle + slope * slope / (8 * bend) : std::max({left, middle, right});
}

double above_nothing(double value) { return value > kNothing ? value : 0; }

}  // namespace

Overshoot overshoot(std::span<const double> gains) {
  const std::vector<double> series = filtered_step(gains);
  const std::size_t n = kPointsPerHalfWave * (gains.size() + 1);
  std::vector<double> values(n + 3);  // one more on both sides, mirrored in the poles
  for (std::size_t i = 0; i <= n; ++i) {
    const double theta = std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    values[i + 1] = sum_at(series, std::cos(theta));
  }
  values[0] = values[2];
  values[n + 2] = values[n];
  double high = values[1], low = -values[1];
  for (std::size_t i = 1; i <= n + 1; ++i) {
    high = std::max(high, crest(values[i - 1], values[i], values[i + 1]));
    low = std::max(low, crest(-values[i - 1], -values[i], -values[i + 1]));
  }
  return {above_nothing(high - 1), above_nothing(low)};
}

Overshoot overshoot(Window window, int degree) {
  if (degree < 0 || degree > kMaxDegree) {
    throw Error(ErrorCode::kInvalidInput, "degree " + std::to_string(degree) +
                                              " is out of range: choose one from 0 to " +
                                              std::to_string(kMaxDegree));
  }
  // Of heat 2^-64 is left at eight times the degree.
  const int top = window_info(window).cut_off ? degree : std::min(8 * degree + 8, kMaxDegree);
  return overshoot(low_pass(degree, top, {.window = window}));
}

}  // namespace rholm
