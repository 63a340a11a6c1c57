// Descriptors and centroid of an expansion, as rholm info and batches report them. Layer: cli.
#pragma once

#include <optional>
#include <string>

#include "cli/terminal/json_text.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/synthesize.h"

namespace rholm::cli {

struct MeasuresReport {
  std::optional<SurfaceMeasures> measures;  // none for what is no surface, and above degree 512
  std::string why_not;                      // the message of what was refused; empty: nothing was
};

MeasuresReport measures_of(const Expansion& expansion, const Context& context);

// Each descriptor by its name, and "volume_centroid"; null where they are not known.
Json measures_json(const std::optional<SurfaceMeasures>& measures);

// "volume, area and sphericity", for help.
std::string descriptor_names();

}  // namespace rholm::cli
