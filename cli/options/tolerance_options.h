// "--tolerance E" and what it means. Layer: cli.
#pragma once

#include <optional>
#include <vector>

#include "cli/grammar/command.h"
#include "cli/options/field_options.h"
#include "rholm/truncation.h"

namespace rholm::cli {

struct ToleranceOptions {
  std::optional<double> tolerance;
  Given<Tolerance> rest;  // but the error itself

  // None without --tolerance. Throws UsageError for options that do not go together.
  std::optional<Tolerance> parsed() const;
};

// --tolerance, --unit, --norm, --measure, --max-degree.
std::vector<Option> tolerance_options(ToleranceOptions& options);

}  // namespace rholm::cli
