// Descriptors and centroid of an expansion, for rholm info and batches. Layer: cli.
#pragma once

#include <optional>
#include <string>

#include "cli/terminal/json_text.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/synthesize.h"

namespace rholm::cli {

struct MeasuresReport {
  std::optional<SurfaceMeasures> measures;  // empty without a surface, and above degree 512
  std::string why_not;                      // message of the refusal; empty: no refusal
};

MeasuresReport measures_of(const Expansion& expansion, const Context& context);

// Returns each descriptor by name, and "volume_centroid"; null for unknown values.
Json measures_json(const std::optional<SurfaceMeasures>& measures);

// Returns "volume, area and sphericity", for help.
std::string descriptor_names();

}  // namespace rholm::cli
