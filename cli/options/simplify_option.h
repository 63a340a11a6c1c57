// "--simplify": fewer triangles for the same surface. Layer: cli.
#pragma once

#include <optional>
#include <string>

#include "cli/grammar/command.h"
#include "rholm/simplify.h"

namespace rholm::cli {

inline constexpr const char* kNotSimplified = "none";

// "--simplify auto|N|P%|none". `by_default` says in the help what is done without it.
Option simplify_option(std::string& text,
                       const char* by_default = "none, the default, leaves it whole");

// Throws UsageError, naming the option as it is typed, for what it may not be.
std::optional<SimplifyOptions> parse_simplify(const std::string& option, const std::string& text);

}  // namespace rholm::cli
