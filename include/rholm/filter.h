// Filters: a factor for each degree, the same for all its orders. Layer: harmonic.
//
// A filter is a vector of gains g_0 ... g_N; degrees above N have gain 0. Factors that do not
// depend on the order leave the filter blind to how the shape is turned.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/fields.h"

namespace rholm {

// How a low-pass filter falls from 1 at degree 0 to 0 above its degree L. Sharper is closer to the
// shape and rings more at edges. windows() has what each is.
enum class Window {
  // The row of that name in windows().
  kIdeal,
  kLanczos,
  kLanczos2,
  kGaussian,
  kHeat,
  kExponential,
  kPlateau
};

// A window, and the parameters of all windows. A window uses its own parameters only.
struct WindowOptions {
  Window window = Window::kLanczos;  // how it falls
  int order = 4;                     // p of kExponential
  // t of kHeat. By default the gain at L is 1/2, t = ln 2 / (L(L+1)).
  std::optional<double> time = {};
};

// A parameter of a window.
struct WindowParameter {
  const char* name;    // of the field, of the option of the program, of the argument in Python
  const char* symbol;  // in formulas
  const char* help;    // one sentence without a full stop
  std::variant<int WindowOptions::*, std::optional<double> WindowOptions::*> field;  // that it is
  double min, max;               // the range, both ends allowed
  bool replaces_cutoff = false;  // whether L is not used where the parameter is given

  // Whether only whole numbers are values.
  bool whole() const { return std::holds_alternative<int WindowOptions::*>(field); }
  // The value in `options`; nothing where a window chooses it by L.
  std::optional<double> value(const WindowOptions& options) const;
  // Throws InvalidInput for a value out of range, and for a fraction where the field is whole.
  void set(WindowOptions& options, double value) const;
};

// All that is known of a window. The program, Python, the studio and docs/reference.md have their
// windows from here.
struct WindowInfo {
  Window window;        // its number
  const char* name;     // "lanczos"
  const char* formula;  // the gain of degree l up to L, in one line
  const char* help;     // what the window is good for, one sentence without a full stop
  // Of a step at L = 64 (see overshoot() below), in two digits; 0 for none.
  double overshoot;
  // The gain of degree l >= 0; above L it is used only where `cut_off` is false.
  double (*gain)(double l, double cutoff, const WindowOptions& options);
  std::span<const WindowParameter> parameters = {};  // that it uses
  bool cut_off = true;                               // whether the gain is 0 above L
};

// All windows, each once, in the order of their numbers.
std::span<const WindowInfo> windows();
const WindowInfo& window_info(Window window);  // throws InvalidInput for a number without a window
const char* to_string(Window window);          // "ideal", "lanczos", "lanczos2", ...
Window parse_window(const std::string& name);  // throws InvalidInput

// Gains of degrees 0 ... `degree`. cutoff is the L of the window, 0 ... kMaxDegree; a parameter may
// replace it. Each throws InvalidInput for a parameter or degree out of range.
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

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<Overshoot>, const Visitor& field) {
  using O = Overshoot;
  field(&O::above, {.name = "above", .help = "largest value - 1"});
  field(&O::below, {.name = "below", .help = "minus the smallest value"});
}
// Of the function that is 1 within 60 degrees of the pole and 0 beyond, whose coefficients are
// known in closed form, (P_{l-1}(1/2) - P_{l+1}(1/2)) / 2.
Overshoot overshoot(std::span<const double> gains);
// Of low_pass(degree); of a window that is not cut off to 8 times the degree.
Overshoot overshoot(Window window, int degree);

}  // namespace rholm
