#include "cli/options/convention.h"

#include <fmt/format.h>

namespace rholm::cli {
namespace {

const std::vector<std::string> kNormalizations = {"4pi", "orthonormal", "schmidt"};
const std::vector<std::string> kPhases = {"1", "-1"};

int phase_of(const std::string& text) { return text == "-1" ? -1 : 1; }

}  // namespace

Convention ConventionOptions::output_convention() const {
  return {parse_name<Normalization>(normalization), phase_of(csphase)};
}

std::vector<Option> convention_options(ConventionOptions& target) {
  ConventionOptions& o = target;
  return {{.name = "normalization",
           .help = "how the functions are scaled in text, JSON and NumPy files; 4pi by default",
           .target = &o.normalization,
           .choices = kNormalizations},
          {.name = "csphase",
           .help = "1 (the default): without Condon-Shortley phase; -1: with it",
           .target = &o.csphase,
           .choices = kPhases}};
}

CoefficientsReadOptions InputConvention::reading() const {
  CoefficientsReadOptions options;
  if (!normalization.empty())
    options.convention.normalization = parse_name<Normalization>(normalization);
  options.convention.csphase = phase_of(csphase);
  options.override_file = override_file;
  return options;
}

std::vector<std::string> InputConvention::left_open(const std::vector<std::string>& assumed) const {
  std::vector<std::string> open;
  for (const std::string& what : assumed) {
    const bool given = (what.starts_with("normalization ") && !normalization.empty()) ||
                       (what.starts_with("csphase ") && !csphase.empty());
    if (!given) open.push_back(what);
  }
  return open;
}

std::vector<Option> input_convention_options(InputConvention& target) {
  InputConvention& o = target;
  return {{.name = "input-normalization",
           .help = "how the functions of the input are scaled, where its file does not say; 4pi by "
                   "default",
           .target = &o.normalization,
           .choices = kNormalizations},
          {.name = "input-csphase",
           .help = "phase of the input, where its file does not say; 1 (without) by default",
           .target = &o.csphase,
           .choices = kPhases}};
}

std::string text_of(const Convention& convention) {
  return fmt::format("normalization {}, csphase {}", to_string(convention.normalization),
                     convention.csphase);
}

}  // namespace rholm::cli
