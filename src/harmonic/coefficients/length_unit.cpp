#include "rholm/length_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "rholm/error.h"

namespace rholm {
namespace {

struct Unit {
  std::string_view name;
  double metres;
};

// Symbols of units, in which upper and lower case differ.
constexpr std::array<Unit, 23> kSymbols = {{{"m", 1},
                                            {"fm", 1e-15},
                                            {"pm", 1e-12},
                                            {"nm", 1e-9},
                                            {"um", 1e-6},
                                            {"\u00b5m", 1e-6},  // the micro sign
                                            {"\u03bcm", 1e-6},  // the Greek letter
                                            {"mm", 1e-3},
                                            {"cm", 1e-2},
                                            {"dm", 1e-1},
                                            {"dam", 1e1},
                                            {"hm", 1e2},
                                            {"km", 1e3},
                                            {"KM", 1e3},
                                            {"Km", 1e3},
                                            {"Mm", 1e6},
                                            {"Gm", 1e9},
                                            {"in", 0.0254},
                                            {"ft", 0.3048},
                                            {"yd", 0.9144},
                                            {"mi", 1609.344},
                                            {"au", 149597870700.0},
                                            {"AU", 149597870700.0}}};

// Names of units in lower case, in the singular and in the American spelling ("er" for "re").
constexpr std::array<Unit, 12> kWords = {{{"meter", 1},
                                          {"nanometer", 1e-9},
                                          {"micrometer", 1e-6},
                                          {"micron", 1e-6},
                                          {"millimeter", 1e-3},
                                          {"centimeter", 1e-2},
                                          {"kilometer", 1e3},
                                          {"angstrom", 1e-10},
                                          {"inch", 0.0254},
                                          {"foot", 0.3048},
                                          {"yard", 0.9144},
                                          {"mile", 1609.344}}};

template <std::size_t kUnits>
std::optional<double> found(const std::array<Unit, kUnits>& units, std::string_view name) {
  const auto unit = std::find_if(units.begin(), units.end(),
                                 [&](const Unit& known) { return known.name == name; });
  return unit == units.end() ? std::nullopt : std::optional(unit->metres);
}

void scale(std::optional<double>& value, double factor) {
  if (value) *value *= factor;
}

}  // namespace

std::optional<double> metres_of(const std::string& unit) {
  if (const auto metres = found(kSymbols, unit)) return metres;
  std::string word = unit;
  for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (word == "feet") word = "foot";
  if (word == "inches") word = "inch";
  if (word.size() > 1 && word.ends_with('s')) word.pop_back();
  if (word.ends_with("metre")) word.replace(word.size() - 2, 2, "er");
  return found(kWords, word);
}

Expansion scaled(const Expansion& expansion, double factor) {
  if (!(std::isfinite(factor) && factor > 0)) {
    throw Error(ErrorCode::kInvalidInput, "the factor of lengths is " + std::to_string(factor) +
                                              ": it must be finite and above 0");
  }
  Expansion result = expansion;
  // The gauge is the inverse of a length; a function that is not of a surface holds no length.
  const double f = expansion.function == RadialFunction::kRadius  ? factor
                   : expansion.function == RadialFunction::kGauge ? 1 / factor
                                                                  : 1;
  for (double& value : result.coefficients.values()) value *= f;
  result.center = factor * result.center;
  scale(result.norm_squared, f * f);
  scale(result.tail_strength, f * f);
  if (!result.errors) return result;
  TruncationErrors& errors = *result.errors;
  for (std::optional<double>* length :
       {&errors.rms, &errors.predicted_max, &errors.predicted_max_distance, &errors.measured_max,
        &errors.measured_max_distance, &errors.max_bound, &errors.distance_rms}) {
    scale(*length, factor);
  }
  errors.diagonal *= factor;
  return result;
}

}  // namespace rholm
