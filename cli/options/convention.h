// Convention of coefficients: --normalization and --csphase for a file to write,
// --input-normalization and --input-csphase for a file to read. Layer: cli.
#pragma once

#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "rholm/coefficients_io.h"

namespace rholm::cli {

struct ConventionOptions {
  std::string normalization = "4pi";
  std::string csphase = "1";

  Convention output_convention() const;
};
std::vector<Option> convention_options(ConventionOptions& target);

// Convention of an input whose file states none; empty: not given.
struct InputConvention {
  std::string normalization;
  std::string csphase;
  bool override_file = false;  // true: use the options even if the file states another convention

  CoefficientsReadOptions reading() const;
  // Returns the reader's assumptions that these options do not set.
  std::vector<std::string> left_open(const std::vector<std::string>& assumed) const;
};
// Returns the options of every command that reads coefficients.
std::vector<Option> input_convention_options(InputConvention& target);

// Returns "normalization 4pi, csphase 1".
std::string text_of(const Convention& convention);

}  // namespace rholm::cli
