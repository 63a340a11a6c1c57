#include "cli/convention.h"

#include <fmt/format.h>

#include "cli/parse.h"

namespace rholm::cli {

Convention ConventionOptions::output_convention() const {
  if (csphase != 1 && csphase != -1) {
    throw UsageError(fmt::format("--csphase is {}; it must be 1 or -1", csphase));
  }
  return {parse_normalization(normalization), csphase};
}

Option normalization_option(std::string& target, const std::string& prefix) {
  const bool input = !prefix.empty();
  return {.name = prefix + "normalization",
          .help = input ? "how the functions of the input are scaled, where its file does not say"
                        : "how the functions are scaled in text, JSON and NumPy files; 4pi by "
                          "default",
          .target = &target,
          .choices = {"4pi", "orthonormal", "schmidt"}};
}

Option csphase_option(int& target, const std::string& prefix) {
  const bool input = !prefix.empty();
  return {.name = prefix + "csphase",
          .value = "1|-1",
          .help = input ? "phase of the input, where its file does not say"
                        : "1 (the default): without Condon-Shortley phase; -1: with it",
          .target = &target};
}

std::string text_of(const Convention& convention) {
  return fmt::format("normalization {}, csphase {}", to_string(convention.normalization),
                     convention.csphase);
}

}  // namespace rholm::cli
