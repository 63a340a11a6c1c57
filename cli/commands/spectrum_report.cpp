#include "cli/commands/spectrum_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rholm::cli {

// Summed from the top, so that small remainders are not lost against the large first degrees.
Spectrum spectrum_of(const Expansion& expansion) {
  Spectrum s;
  s.energy = power_spectrum(expansion.coefficients);
  const std::size_t n = s.energy.size();
  s.cumulative.resize(n);
  s.rms_beyond.resize(n);
  double sum = 0;
  for (std::size_t l = 0; l < n; ++l) s.cumulative[l] = sum += s.energy[l];
  s.includes_tail = expansion.norm_squared.has_value();
  double beyond = s.includes_tail ? std::max(0.0, *expansion.norm_squared - sum) : 0.0;
  for (std::size_t l = n; l-- > 0;) {
    s.rms_beyond[l] = std::sqrt(beyond / (4 * std::numbers::pi));
    beyond += s.energy[l];
  }
  return s;
}

Json spectrum_json(const Expansion& expansion, const Spectrum& s) {
  Json json;
  json["degree"] = expansion.coefficients.degree();
  json["function"] = to_string(expansion.function);
  json["energy"] = s.energy;
  json["cumulative"] = s.cumulative;
  json["rms_beyond"] = s.rms_beyond;
  json["rms_beyond_includes_tail"] = s.includes_tail;
  return json;
}

}  // namespace rholm::cli
