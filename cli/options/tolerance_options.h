// "--tolerance E" and its interpretation. Layer: cli.
#pragma once

#include <optional>
#include <vector>

#include "cli/grammar/command.h"
#include "cli/options/field_options.h"
#include "rholm/truncation.h"

namespace rholm::cli {

struct ToleranceOptions {
  std::optional<double> tolerance;
  Given<Tolerance> rest;  // without the error itself

  // Returns nothing without --tolerance. Throws UsageError for incompatible options.
  std::optional<Tolerance> parsed() const;
};

// Returns --tolerance, --unit, --norm, --measure, --max-degree.
std::vector<Option> tolerance_options(ToleranceOptions& options);

}  // namespace rholm::cli
