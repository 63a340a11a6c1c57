// Energy per degree, for rholm spectrum and batches. Layer: cli.
#pragma once

#include <vector>

#include "cli/terminal/json_text.h"
#include "rholm/coefficients.h"
#include "rholm/rms_beyond.h"

namespace rholm::cli {

struct Spectrum {
  std::vector<double> energy;      // per degree
  std::vector<double> cumulative;  // energy of degrees 0 ... l
  RmsBeyond beyond;
  std::vector<std::optional<double>> rms;  // RmsBeyond::figures()
};

Spectrum spectrum_of(const Expansion& expansion);

// Returns a description of the expansion, and its spectrum.
Json spectrum_json(const Expansion& expansion, const Spectrum& s);

}  // namespace rholm::cli
