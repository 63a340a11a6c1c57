// Filters: a factor for each degree, the same for all its orders. Layer: harmonic.
//
// A filter is a vector of gains g_0 ... g_N; degrees above N have gain 0. Factors that do not
// depend on the order leave the filter blind to how the shape is turned.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rholm/coefficients.h"

namespace rholm {

// How a low-pass filter falls from 1 at degree 0 to 0 above its degree L. Sharper is closer to the
// shape and rings more at edges: overshoot() of each at L = 64, in parts of the step.
enum class Window {
  kIdeal,        // 1 to L: 8.8 %
  kLanczos,      // sigma, sin(x)/x with x = pi l/(L + 1): 1.4 %
  kLanczos2,     // its square: 0.46 %
  kGaussian,     // exp(-2.4 l(l+1) / (L(L+1))), cut off at L: 0.26 %
  kHeat,         // exp(-t l(l+1)), the surface of heat after time t, not cut off: none
  kExponential,  // exp(-36 (l/(L+1))^p), rounding noise at L + 1: 5.7 % for p = 4
  kPlateau       // 1 to L/2, then an infinitely smooth step as of needlets: 8.6 %
};
const char* to_string(Window window);          // "ideal", "lanczos", "lanczos2", ...
Window parse_window(const std::string& name);  // throws InvalidInput

// A window, and its parameter if it has one.
struct WindowOptions {
  Window window = Window::kLanczos;  // how it falls
  int order = 4;                     // p of kExponential, 1 ... 64
  // t of kHeat, above 0. By default the gain at L is 1/2, t = ln 2 / (L(L+1)).
  std::optional<double> time = {};
};

// Gains of degrees 0 ... `degree`. cutoff is the L of the window, 0 ... kMaxDegree; for kHeat with
// a time it is not used. Each throws InvalidInput for an order, time or degree out of range.
//
// low_pass keeps degrees up to cutoff; high_pass those from cutoff >= 1 on, 1 - low_pass(cutoff -
// 1); band_pass those from `from` to `to` >= from, low_pass(to) - low_pass(from - 1).
std::vector<double> low_pass(int cutoff, int degree, const WindowOptions& options = {});
std::vector<double> high_pass(int cutoff, int degree, const WindowOptions& options = {});
std::vector<double> band_pass(int from, int to, int degree, const WindowOptions& options = {});

// Unsharp masking: 1 + amount (1 - g), of the gains of a low-pass filter.
std::vector<double> sharpened(std::span<const double> gains, double amount);

// c_lm times g_l, cut off after the last degree whose gain is not 0. Throws InvalidInput for a
// gain that is not finite.
Coefficients filter(const Coefficients& coefficients, std::span<const double> gains);

// The same of a surface. `name` says what was done and is added to the expansion's method. Norm
// and tail of the unfiltered function are dropped. Of errors those of the radius stay that follow:
// with E_l the energy of degree l, rms^2 grows by sum (1 - g_l)^2 E_l / (4 pi), as the degrees of a
// radius are orthogonal to each other and to what its expansion leaves out.
Expansion filter(const Expansion& expansion, std::span<const double> gains,
                 const std::string& name);

// A surface cut off at a degree; unchanged if it has no higher ones. Norm and tail stay, as they
// are of the whole function. Errors follow as for filter(). Throws InvalidInput for a negative
// degree.
Expansion truncated(const Expansion& expansion, int degree);

// How far a filtered step leaves 0 ... 1, in parts of its height. Each 0 where it does not (below
// 1e-12).
struct Overshoot {
  double above = 0;  // largest value - 1
  double below = 0;  // - smallest value
};
// Of the function that is 1 within 60 degrees of the pole and 0 beyond, whose coefficients are
// known in closed form, (P_{l-1}(1/2) - P_{l+1}(1/2)) / 2.
Overshoot overshoot(std::span<const double> gains);
Overshoot overshoot(Window window, int degree);  // of low_pass(degree), kHeat to 8 times the degree

}  // namespace rholm
