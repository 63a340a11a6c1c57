// Filters: a factor for each degree, the same for all its orders. Layer: harmonic.
//
// A filter is a vector of gains g_0 ... g_N; degrees above N have gain 0. Gains do not depend on
// the order m, so filtering commutes with rotation of the shape.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/fields.h"

namespace rholm {

// Shapes of the fall of a low-pass filter from 1 at degree 0 to 0 above its degree L. A sharper
// fall keeps more of the shape and rings more at edges. windows() describes each one.
enum class Window {
  // Each value is described by its row in windows().
  kIdeal,
  kLanczos,
  kLanczos2,
  kGaussian,
  kHeat,
  kExponential,
  kPlateau
};

// A window, and the parameters of all windows. Each window uses only its own parameters.
struct WindowOptions {
  Window window = Window::kLanczos;  // shape of the fall
  int order = 4;                     // p of kExponential
  // t of kHeat. By default t = ln 2 / (L(L+1)), so that the gain at L is 1/2.
  std::optional<double> time = {};
};

// A parameter of a window.
struct WindowParameter {
  const char* name;    // name of the field, the program's option, and the Python argument
  const char* symbol;  // symbol in formulas
  const char* help;    // one sentence without a full stop
  std::variant<int WindowOptions::*, std::optional<double> WindowOptions::*> field;  // member set
  double min, max;               // range, both ends allowed
  bool replaces_cutoff = false;  // true if L is not used where the parameter is given

  // Returns true if only whole numbers are allowed.
  bool whole() const { return std::holds_alternative<int WindowOptions::*>(field); }
  // Returns the value in `options`; nothing where the window chooses it from L.
  std::optional<double> value(const WindowOptions& options) const;
  // Sets the value. Throws InvalidInput if out of range, or for a fraction in a whole-number field.
  void set(WindowOptions& options, double value) const;
};

// Description of a window. The program, Python, the studio and docs/reference.md take their windows
// from this table.
struct WindowInfo {
  Window window;        // the enum value
  const char* name;     // "lanczos"
  const char* formula;  // gain of degree l up to L, in one line
  const char* help;     // use of the window, one sentence without a full stop
  // Overshoot of a step at L = 64 (see overshoot() below), to two digits; 0 for none.
  double overshoot;
  // Returns the gain of degree l >= 0; above L it is used only if `cut_off` is false.
  double (*gain)(double l, double cutoff, const WindowOptions& options);
  std::span<const WindowParameter> parameters = {};  // parameters it uses
  bool cut_off = true;                               // true if the gain is 0 above L
};

// Returns all windows, each once, in the order of the enum.
std::span<const WindowInfo> windows();
const WindowInfo& window_info(Window window);  // throws InvalidInput for a number without a window
const char* to_string(Window window);          // "ideal", "lanczos", "lanczos2", ...
Window parse_window(const std::string& name);  // throws InvalidInput

// Return the gains of degrees 0 ... `degree`. cutoff is the L of the window, 0 ... kMaxDegree; a
// parameter may replace it. Each throws InvalidInput for a parameter or degree out of range.
//
// low_pass keeps degrees up to cutoff. high_pass keeps degrees from cutoff >= 1 on: 1 -
// low_pass(cutoff - 1). band_pass keeps `from` ... `to` >= from: low_pass(to) - low_pass(from - 1).
std::vector<double> low_pass(int cutoff, int degree, const WindowOptions& options = {});
std::vector<double> high_pass(int cutoff, int degree, const WindowOptions& options = {});
std::vector<double> band_pass(int from, int to, int degree, const WindowOptions& options = {});

// Returns 1 + amount (1 - g) for the gains of a low-pass filter: unsharp masking.
std::vector<double> sharpened(std::span<const double> gains, double amount);

// Returns c_lm times g_l, cut off after the last degree whose gain is not 0. Throws InvalidInput
// for a gain that is not finite.
Coefficients filter(const Coefficients& coefficients, std::span<const double> gains);

// Filters a surface. `name` names the filter and is added to the expansion's method. Norm and tail
// are dropped. Errors of the radius are kept if they follow: with E_l the energy of degree l, rms^2
// grows by sum (1 - g_l)^2 E_l / (4 pi). The degrees of a radius are orthogonal to each other and
// to its truncation error.
Expansion filter(const Expansion& expansion, std::span<const double> gains,
                 const std::string& name);

// Returns a surface cut off at a degree; unchanged if it has no higher degrees. Norm and tail stay,
// because they describe the whole function. Errors follow as in filter(). Throws InvalidInput for a
// negative degree.
Expansion truncated(const Expansion& expansion, int degree);

// Overshoot of a filtered step beyond 0 ... 1, relative to its height. A value below 1e-12 is given
// as 0.
struct Overshoot {
  double above = 0;  // largest value - 1
  double below = 0;  // minus the smallest value
};

// Lists the fields of Overshoot.
template <typename Visitor>
void visit_fields(FieldsOf<Overshoot>, const Visitor& field) {
  using O = Overshoot;
  field(&O::above, {.name = "above", .help = "largest value - 1"});
  field(&O::below, {.name = "below", .help = "minus the smallest value"});
}
// Returns the overshoot for a step: 1 within 60 degrees of the pole and 0 beyond. Its coefficients
// are known in closed form, (P_{l-1}(1/2) - P_{l+1}(1/2)) / 2.
Overshoot overshoot(std::span<const double> gains);
// Returns the overshoot of low_pass(degree); a window without cut-off is used to 8 times `degree`.
Overshoot overshoot(Window window, int degree);

}  // namespace rholm
