// From the words of a command line to the targets of a command's options. Layer: cli.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

// The value of an option that is a number within its bounds; throws UsageError.
double number_within(const Option& option, const std::string& text);
std::uint64_t whole_within(const Option& option, const std::string& text);

// Fills the targets of the command's options and of the common ones from `words` (without the
// command's name). Throws UsageError.
void parse(const Command& command, std::span<const std::string> words, CommonOptions& common);

}  // namespace rholm::cli
