// "--simplify": fewer faces for the same surface. Layer: cli.
#pragma once

#include <optional>
#include <string>

#include "cli/grammar/command.h"
#include "rholm/simplify.h"

namespace rholm::cli {

inline constexpr const char* kNotSimplified = "none";

// Option "--simplify auto|N|P%|none". `by_default` describes the default in the help.
Option simplify_option(std::string& text,
                       const char* by_default = "none keeps all faces; none by default");

// Parses a value. Throws UsageError with the option as typed for a wrong one.
std::optional<SimplifyOptions> parse_simplify(const std::string& option, const std::string& text);

}  // namespace rholm::cli
