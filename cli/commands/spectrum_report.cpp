#include "cli/commands/spectrum_report.h"

namespace rholm::cli {

Spectrum spectrum_of(const Expansion& expansion) {
  Spectrum s;
  s.energy = power_spectrum(expansion.coefficients);
  s.cumulative.resize(s.energy.size());
  double sum = 0;
  for (std::size_t l = 0; l < s.energy.size(); ++l) s.cumulative[l] = sum += s.energy[l];
  s.beyond = rms_beyond(expansion);
  s.rms = s.beyond.figures();
  return s;
}

Json spectrum_json(const Expansion& expansion, const Spectrum& s) {
  Json json;
  json["degree"] = expansion.coefficients.degree();
  json["function"] = to_string(expansion.function);
  json["energy"] = s.energy;
  json["cumulative"] = s.cumulative;
  json["rms_beyond"] = Json::array();
  for (const std::optional<double>& rms : s.rms) json["rms_beyond"].push_back(json_of(rms));
  json["rms_beyond_includes_tail"] = s.beyond.includes_tail();
  json["rms_beyond_bound"] = json_of(s.beyond.bound());
  json["precision"] = json_of(expansion.precision);
  return json;
}

}  // namespace rholm::cli
