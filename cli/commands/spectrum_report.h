// Energy per degree, as rholm spectrum and batches report it. Layer: cli.
#pragma once

#include <vector>

#include "cli/terminal/json_text.h"
#include "rholm/coefficients.h"
#include "rholm/rms_beyond.h"

namespace rholm::cli {

struct Spectrum {
  std::vector<double> energy;      // per degree
  std::vector<double> cumulative;  // of degrees 0 ... l
  RmsBeyond beyond;
  std::vector<std::optional<double>> rms;  // RmsBeyond::figures()
};

Spectrum spectrum_of(const Expansion& expansion);

// What the expansion is, and its spectrum.
Json spectrum_json(const Expansion& expansion, const Spectrum& s);

}  // namespace rholm::cli
