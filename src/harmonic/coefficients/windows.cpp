// The table of windows: its row describes a window completely.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

#include "base/refuse.h"
#include "rholm/filter.h"

namespace rholm {
namespace {

// Exponent of the Gaussian at degree L, so that a gain of 0.09 is left there. Chosen as a trade
// between the overshoot of a Gaussian cut off at L and its blur.
constexpr double kGaussianWidth = 2.4;

// exp(-36) is 2^-52, so that the cutoff removes nothing more (Gottlieb and Shu 1997).
constexpr double kExponentialDepth = 36;

double sinc(double x) { return x == 0 ? 1 : std::sin(x) / x; }

double lanczos(double l, double cutoff) { return sinc(std::numbers::pi * (l / (cutoff + 1))); }

// Returns L(L+1), the eigenvalue of the Laplacian at degree L, but 1 at degree 0.
double eigenvalue(double cutoff) { return std::max(cutoff * (cutoff + 1), 1.0); }

// Falls from 1 at x = 0 to 0 at x = 1, with all derivatives 0 at both ends:
// e(1-x) / (e(1-x) + e(x)) with e(x) = exp(-1/x).
double smooth_step(double x) {
  if (x <= 0) return 1;
  if (x >= 1) return 0;
  return 1 / (1 + std::exp(1 / (1 - x) - 1 / x));
}

constexpr WindowParameter kTime[] = {{.name = "time",
                                      .symbol = "t",
                                      .help = "by default the gain at degree L is a half",
                                      .field = &WindowOptions::time,
                                      .min = 1e-12,
                                      .max = 1e6,
                                      .replaces_cutoff = true}};
constexpr WindowParameter kOrder[] = {{.name = "order",
                                       .symbol = "p",
                                       .help = "a higher order is sharper",
                                       .field = &WindowOptions::order,
                                       .min = 1,
                                       .max = 64}};

constexpr WindowInfo kWindows[] = {
    {.window = Window::kIdeal,
     .name = "ideal",
     .formula = "1",
     .help = "the closest to the shape, and the most ringing",
     .overshoot = 0.089,
     .gain = [](double, double, const WindowOptions&) { return 1.0; }},
    {.window = Window::kLanczos,
     .name = "lanczos",
     .formula = "sin(x)/x, x = pi l/(L+1)",
     .help = "little ringing, and detail nearly up to degree L",
     .overshoot = 0.014,
     .gain = [](double l, double cutoff, const WindowOptions&) { return lanczos(l, cutoff); }},
    {.window = Window::kLanczos2,
     .name = "lanczos2",
     .formula = "(sin(x)/x)^2, x = pi l/(L+1)",
     .help = "the square of lanczos: less ringing, more blur",
     .overshoot = 0.0046,
     .gain = [](double l, double cutoff,
                const WindowOptions&) { return std::pow(lanczos(l, cutoff), 2); }},
    {.window = Window::kGaussian,
     .name = "gaussian",
     .formula = "exp(-2.4 l(l+1)/(L(L+1)))",
     .help = "nearly a blur by a Gaussian on the sphere",
     .overshoot = 0.0026,
     .gain =
         [](double l, double cutoff, const WindowOptions&) {
           return std::exp(-kGaussianWidth * (l * (l + 1)) / eigenvalue(cutoff));
         }},
    {.window = Window::kHeat,
     .name = "heat",
     .formula = "exp(-t l(l+1)), not cut off at L",
     .help = "the surface as heat spreads for the time t: no ringing, and a positive radius stays "
             "positive",
     .overshoot = 0,
     .gain =
         [](double l, double cutoff, const WindowOptions& options) {
           const double half_at_cutoff = std::numbers::ln2 / eigenvalue(cutoff);
           return std::exp(-options.time.value_or(half_at_cutoff) * (l * (l + 1)));
         },
     .parameters = kTime,
     .cut_off = false},
    {.window = Window::kExponential,
     .name = "exponential",
     .formula = "exp(-36 (l/(L+1))^p)",
     .help = "from a blur to nearly ideal, by the order p",
     .overshoot = 0.057,
     .gain =
         [](double l, double cutoff, const WindowOptions& options) {
           return std::exp(-kExponentialDepth * std::pow(l / (cutoff + 1), options.order));
         },
     .parameters = kOrder},
    {.window = Window::kPlateau,
     .name = "plateau",
     .formula = "1 to L/2, then an infinitely smooth step to 0 at L+1, as of needlets",
     .help = "degrees up to L/2 stay as they are",
     .overshoot = 0.086,
     .gain = [](double l, double cutoff,
                const WindowOptions&) { return smooth_step(2 * (l / (cutoff + 1)) - 1); }},
#ifdef RHOLM_EXTRA_WINDOWS  // tests/one_list adds a row here
#include RHOLM_EXTRA_WINDOWS
#endif
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < std::size(kWindows); ++i) {
    if (kWindows[i].window != static_cast<Window>(i)) return false;
  }
  return true;
}
static_assert(in_order(), "the row of a window is its number");

}  // namespace

std::optional<double> WindowParameter::value(const WindowOptions& options) const {
  if (const auto* field_of_whole = std::get_if<int WindowOptions::*>(&field)) {
    return options.*(*field_of_whole);
  }
  return options.*std::get<std::optional<double> WindowOptions::*>(field);
}

void WindowParameter::set(WindowOptions& options, double value) const {
  if (!(value >= min && value <= max) || (whole() && value != std::trunc(value))) {
    refuse(fmt::format("{} {} is out of range: choose a {} from {} to {}", name, value,
                       whole() ? "whole number" : "number", min, max));
  }
  if (const auto* field_of_whole = std::get_if<int WindowOptions::*>(&field)) {
    options.*(*field_of_whole) = static_cast<int>(value);
  } else {
    options.*std::get<std::optional<double> WindowOptions::*>(field) = value;
  }
}

std::span<const WindowInfo> windows() { return kWindows; }

const WindowInfo& window_info(Window window) {
  const auto row = static_cast<std::size_t>(window);
  if (row >= std::size(kWindows)) refuse("there is no window " + std::to_string(row));
  return kWindows[row];
}

const char* to_string(Window window) { return window_info(window).name; }

Window parse_window(const std::string& name) {
  std::string names;
  for (const WindowInfo& info : kWindows) {
    if (name == info.name) return info.window;
    const bool first = &info == std::begin(kWindows), last = &info + 1 == std::end(kWindows);
    names += std::string(first ? "" : last ? " or " : ", ") + "'" + info.name + "'";
  }
  refuse("unknown window: it must be " + names);
}

}  // namespace rholm
