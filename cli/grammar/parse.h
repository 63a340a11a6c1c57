// Parses the words of a command line into the targets of a command's options. Layer: cli.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

// Return the value of a numeric option within its bounds; throw UsageError.
double number_within(const Option& option, const std::string& text);
std::uint64_t whole_within(const Option& option, const std::string& text);

// Parses `words` (without the command's name) into the targets of the command's and the common
// options. Throws UsageError.
void parse(const Command& command, std::span<const std::string> words, CommonOptions& common);

}  // namespace rholm::cli
