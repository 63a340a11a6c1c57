// "--simplify": fewer triangles for the same surface. Layer: cli.
#pragma once

#include <optional>
#include <string>

#include "cli/grammar/command.h"
#include "rholm/simplify.h"

namespace rholm::cli {

inline constexpr const char* kNotSimplified = "none";

// "--simplify auto|N|P%|none".
Option simplify_option(std::string& text);

// Throws UsageError, naming the option as it is typed, for what it may not be.
std::optional<SimplifyOptions> parse_simplify(const std::string& option, const std::string& text);

}  // namespace rholm::cli
