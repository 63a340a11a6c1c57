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
  // What the degrees above each one hold. Without a norm these are the file's own degrees, and the
  // figure of the last one is not known.
  RmsBeyond beyond;
  bool includes_tail = false;  // what lies above L, too
};

Spectrum spectrum_of(const Expansion& expansion);

// What the expansion is, and its spectrum.
Json spectrum_json(const Expansion& expansion, const Spectrum& s);

}  // namespace rholm::cli
