// Names of options in the previous version. Layer: cli.
#pragma once

#include <string>
#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

// Replaces old names, which this version still understands, by present names. Returns a note for
// each.
std::vector<std::string> replace_old_names(const Command& command, std::vector<std::string>& words);

}  // namespace rholm::cli
