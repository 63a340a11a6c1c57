#include "rholm/filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/refuse.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Largest size in bytes of a text in a model file.
constexpr std::size_t kMaxMethodLength = 256;

void check(int cutoff, int degree, const WindowOptions& options) {
  for (const int l : {cutoff, degree}) {
    if (l < 0 || l > kMaxDegree) {
      refuse("degree " + std::to_string(l) + " of a filter is out of range: choose one from 0 to " +
             std::to_string(kMaxDegree));
    }
  }
  for (const WindowInfo& info : windows()) {
    for (const WindowParameter& parameter : info.parameters) {
      const std::optional<double> value = parameter.value(options);
      if (value && !(*value >= parameter.min && *value <= parameter.max)) {
        refuse(fmt::format("{} {} of the {} window is out of range: choose one from {} to {}",
                           parameter.name, *value, info.name, parameter.min, parameter.max));
      }
    }
  }
}

// Returns true if the options give a parameter that replaces the cutoff.
bool cutoff_is_replaced(const WindowOptions& options) {
  const auto parameters = window_info(options.window).parameters;
  return std::any_of(parameters.begin(), parameters.end(), [&](const WindowParameter& one) {
    return one.replaces_cutoff && one.value(options);
  });
}

}  // namespace

std::vector<double> low_pass(int cutoff, int degree, const WindowOptions& options) {
  check(cutoff, degree, options);
  std::vector<double> gains(static_cast<std::size_t>(degree) + 1);
  const WindowInfo& info = window_info(options.window);
  const int last = info.cut_off ? std::min(cutoff, degree) : degree;
  for (int l = 0; l <= last; ++l) gains[l] = info.gain(l, cutoff, options);
  return gains;
}

std::vector<double> high_pass(int cutoff, int degree, const WindowOptions& options) {
  if (cutoff < 1) refuse("a high-pass filter begins at degree 1 or above");
  std::vector<double> gains = low_pass(cutoff - 1, degree, options);
  for (double& g : gains) g = 1 - g;
  return gains;
}

std::vector<double> band_pass(int from, int to, int degree, const WindowOptions& options) {
  if (from > to) {
    refuse("a band from degree " + std::to_string(from) + " to " + std::to_string(to) +
           " is empty: give the lower degree first");
  }
  if (cutoff_is_replaced(options)) {
    refuse(
        fmt::format("a band has two ends: leave out the parameter of the {} window that stands in "
                    "for its degree",
                    to_string(options.window)));
  }
  std::vector<double> gains = low_pass(to, degree, options);
  if (from == 0) return gains;
  const std::vector<double> below = low_pass(from - 1, degree, options);
  for (std::size_t l = 0; l < gains.size(); ++l) gains[l] -= below[l];
  return gains;
}

std::vector<double> sharpened(std::span<const double> gains, double amount) {
  if (!std::isfinite(amount)) refuse("the amount of sharpening must be finite");
  std::vector<double> result(gains.begin(), gains.end());
  for (double& g : result) g = 1 + amount * (1 - g);
  return result;
}

Coefficients filter(const Coefficients& coefficients, std::span<const double> gains) {
  std::size_t used = std::min(gains.size(), static_cast<std::size_t>(coefficients.degree()) + 1);
  for (std::size_t l = 0; l < used; ++l) {
    if (!std::isfinite(gains[l]))
      refuse("the gain of degree " + std::to_string(l) + " is not finite");
  }
  while (used > 1 && gains[used - 1] == 0) --used;
  Coefficients result = coefficients.resized(used > 0 ? static_cast<int>(used) - 1 : 0);
  for (int l = 0; l <= result.degree(); ++l) {
    const double g = used > 0 ? gains[l] : 0;
    for (int m = 0; m <= l; ++m) {
      result.c(l, m) *= g;
      result.s(l, m) *= g;
    }
  }
  return result;
}

namespace {

// Returns the truncation errors of `expansion` after a filter that scales degree l by gain(l).
template <class Gain>
std::optional<TruncationErrors> filtered_errors(const Expansion& expansion, const Gain& gain) {
  if (!expansion.errors) return std::nullopt;
  const TruncationErrors& old = *expansion.errors;
  TruncationErrors errors;
  errors.diagonal = old.diagonal;
  // Only a radius keeps its RMS error: it is not linear in a gauge, and other functions have none.
  if (!old.rms || expansion.function != RadialFunction::kRadius) return errors;
  const std::vector<double> energy = power_spectrum(expansion.coefficients);
  double lost = 0;
  for (std::size_t l = 0; l < energy.size(); ++l) {
    lost += (1 - gain(l)) * (1 - gain(l)) * energy[l];
  }
  errors.rms = std::sqrt(*old.rms * *old.rms + lost / (4 * std::numbers::pi));
  errors.rms_is_exact = old.rms_is_exact;
  return errors;
}

}  // namespace

Expansion truncated(const Expansion& expansion, int degree) {
  if (degree < 0) refuse("the degree is " + std::to_string(degree) + ": it must be at least 0");
  if (degree >= expansion.coefficients.degree()) return expansion;
  Expansion result = expansion;
  result.coefficients = expansion.coefficients.resized(degree);
  const auto limit = static_cast<std::size_t>(degree);
  result.errors = filtered_errors(expansion, [&](std::size_t l) { return l <= limit ? 1.0 : 0.0; });
  return result;
}

Expansion filter(const Expansion& expansion, std::span<const double> gains,
                 const std::string& name) {
  Expansion result;
  result.coefficients = filter(expansion.coefficients, gains);
  result.function = expansion.function;
  result.center = expansion.center;
  result.unit = expansion.unit;
  result.signed_sum = expansion.signed_sum;
  result.gravity = expansion.gravity;
  const std::string method = expansion.method.empty() ? name : expansion.method + ", " + name;
  result.method = method.size() <= kMaxMethodLength ? method : name.substr(0, kMaxMethodLength);
  result.errors =
      filtered_errors(expansion, [&](std::size_t l) { return l < gains.size() ? gains[l] : 0.0; });
  return result;
}

namespace {

constexpr double kEdge = 0.5;  // The cosine of 60 degrees.

// Number of points per half wave of the highest degree. A parabola through three of the points then
// gives the height of an extremum within a part in a thousand.
constexpr int kPointsPerHalfWave = 16;

// Values below this limit are rounding errors.
constexpr double kNothing = 1e-12;

// Returns gains[l] a_l: a_0 = (1 - x)/2 and a_l = (P_{l-1}(x) - P_{l+1}(x))/2 at x = kEdge.
std::vector<double> filtered_step(std::span<const double> gains) {
  std::vector<double> series(gains.size());
  double before = 1, here = 1, after = kEdge;  // P_{l-1}, P_l and P_{l+1}
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const double l = static_cast<double>(i);
    series[i] = gains[i] * (i == 0 ? 1 - kEdge : before - after) / 2;
    before = here;
    here = after;
    after = ((2 * l + 3) * kEdge * here - (l + 1) * before) / (l + 2);
  }
  return series;
}

// Sums the series at x by Clenshaw's recurrence, with (l+1) P_{l+1} = (2l+1) x P_l - l P_{l-1}.
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

// Returns the maximum of the parabola through three equidistant values if it lies between them, and
// otherwise the largest of the three values.
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
  std::vector<double> values(n + 3);  // one more at either end, mirrored at the pole
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
  // The heat window leaves a gain of 2^-64 at eight times the degree.
  const int top = window_info(window).cut_off ? degree : std::min(8 * degree + 8, kMaxDegree);
  return overshoot(low_pass(degree, top, {.window = window}));
}

}  // namespace rholm
