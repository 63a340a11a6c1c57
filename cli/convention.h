// --normalization and --csphase. Layer: cli.
#pragma once

#include <optional>
#include <string>

#include "cli/command.h"
#include "rholm/coefficients.h"

namespace rholm::cli {

struct ConventionOptions {
  std::string normalization = "4pi";
  int csphase = 1;

  Convention output_convention() const;  // throws UsageError
};

// `prefix` is "" or "input-".
Option normalization_option(std::string& target, const std::string& prefix);
Option csphase_option(int& target, const std::string& prefix);

// "normalization 4pi, csphase 1".
std::string text_of(const Convention& convention);

}  // namespace rholm::cli
