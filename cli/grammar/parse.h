// From the words of a command line to the targets of a command's options. Layer: cli.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

// Fills the targets of the command's options and of the common ones from `words` (without the
// command's name). Throws UsageError.
void parse(const Command& command, std::span<const std::string> words, CommonOptions& common);

}  // namespace rholm::cli
