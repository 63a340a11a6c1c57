// "--tolerance E" and what it means. Layer: cli.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "rholm/truncation.h"

namespace rholm::cli {

struct ToleranceOptions {
  std::optional<double> tolerance;
  std::string norm, measure, unit;  // empty: the default
  std::optional<int> max_degree;

  // None without --tolerance. Throws UsageError for options that do not go together.
  std::optional<Tolerance> parsed() const;
};

// --tolerance, --norm, --measure, --unit, --max-degree.
std::vector<Option> tolerance_options(ToleranceOptions& options);

}  // namespace rholm::cli
