// What numbers of coefficients mean: of a file to write, --normalization and --csphase; of one to
// read, --input-normalization and --input-csphase. Layer: cli.
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

// What is said of an input whose file does not say it; empty: nothing.
struct InputConvention {
  std::string normalization;
  std::string csphase;
  bool override_file = false;  // believe the options even where the file says otherwise

  CoefficientsReadOptions reading() const;
  // Of what the reader had to assume, what these options do not say.
  std::vector<std::string> left_open(const std::vector<std::string>& assumed) const;
};
// Of every command that reads coefficients.
std::vector<Option> input_convention_options(InputConvention& target);

// "normalization 4pi, csphase 1".
std::string text_of(const Convention& convention);

}  // namespace rholm::cli
