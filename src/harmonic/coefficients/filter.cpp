#include "rholm/filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/refuse.h"

namespace rholm {
namespace {

constexpr Window kWindows[] = {Window::kIdeal,    Window::kLanczos, Window::kLanczos2,
                               Window::kGaussian, Window::kHeat,    Window::kExponential,
                               Window::kPlateau};

// Between the largest overshoot and the least blur of Gaussians cut off at L: chosen so that 0.09
// is left at L.
constexpr double kGaussianWidth = 2.4;

// exp(-36) is 2^-52: nothing is left to be cut off (Gottlieb and Shu 1997).
constexpr double kExponentialDepth = 36;

// Texts of a model's file are at most 256 bytes.
constexpr std::size_t kMaxMethodLength = 256;

void check(int cutoff, int degree, const WindowOptions& options) {
  for (const int l : {cutoff, degree}) {
    if (l < 0 || l > kMaxDegree) {
      refuse("degree " + std::to_string(l) + " of a filter is out of range: choose one from 0 to " +
             std::to_string(kMaxDegree));
    }
  }
  if (options.order < 1 || options.order > 64) {
    refuse("order " + std::to_string(options.order) +
           " of the exponential window is out of range: choose one from 1 to 64");
  }
  if (options.time && !(*options.time > 0 && std::isfinite(*options.time))) {
    refuse("time " + std::to_string(*options.time) + " of the heat window must be above 0");
  }
}

double sinc(double x) { return x == 0 ? 1 : std::sin(x) / x; }

// From 1 at x = 0 to 0 at 1, all derivatives 0 at both ends: e(1-x) / (e(1-x) + e(x)) with e(x) =
// exp(-1/x).
double smooth_step(double x) {
  if (x <= 0) return 1;
  if (x >= 1) return 0;
  return 1 / (1 + std::exp(1 / (1 - x) - 1 / x));
}

double gain(const WindowOptions& options, double cutoff, double l) {
  const double of_sphere = l * (l + 1);
  if (options.window == Window::kHeat) {
    const double decay = std::numbers::ln2 / std::max(cutoff * (cutoff + 1), 1.0);
    return std::exp(-options.time.value_or(decay) * of_sphere);
  }
  if (l > cutoff) return 0;
  const double part = l / (cutoff + 1);
  switch (options.window) {
    case Window::kLanczos:
      return sinc(std::numbers::pi * part);
    case Window::kLanczos2:
      return std::pow(sinc(std::numbers::pi * part), 2);
    case Window::kGaussian:
      return std::exp(-kGaussianWidth * of_sphere / std::max(cutoff * (cutoff + 1), 1.0));
    case Window::kExponential:
      return std::exp(-kExponentialDepth * std::pow(part, options.order));
    case Window::kPlateau:
      return smooth_step(2 * part - 1);
    default:
      return 1;
  }
}

}  // namespace

const char* to_string(Window window) {
  switch (window) {
    case Window::kIdeal:
      return "ideal";
    case Window::kLanczos:
      return "lanczos";
    case Window::kLanczos2:
      return "lanczos2";
    case Window::kGaussian:
      return "gaussian";
    case Window::kHeat:
      return "heat";
    case Window::kExponential:
      return "exponential";
    case Window::kPlateau:
      return "plateau";
  }
  return "unknown";
}

Window parse_window(const std::string& name) {
  for (const Window window : kWindows) {
    if (name == to_string(window)) return window;
  }
  refuse(
      "unknown window: it must be 'ideal', 'lanczos', 'lanczos2', 'gaussian', 'heat', "
      "'exponential' or 'plateau'");
}

std::vector<double> low_pass(int cutoff, int degree, const WindowOptions& options) {
  check(cutoff, degree, options);
  std::vector<double> gains(static_cast<std::size_t>(degree) + 1);
  for (int l = 0; l <= degree; ++l) gains[l] = gain(options, cutoff, l);
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
  if (options.window == Window::kHeat && options.time) {
    refuse("a band has two ends: the time of the heat window is that of each, leave it out");
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

// What is known of the errors after a filter with gain(l) for the degrees of `expansion`.
template <class Gain>
std::optional<TruncationErrors> filtered_errors(const Expansion& expansion, const Gain& gain) {
  if (!expansion.errors) return std::nullopt;
  const TruncationErrors& old = *expansion.errors;
  TruncationErrors errors;
  errors.diagonal = old.diagonal;
  // The radius is no linear function of a gauge, and what is no surface has no radius.
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

}  // namespace rholm
