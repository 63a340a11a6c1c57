// Names that options had in the version before. Layer: cli.
#pragma once

#include <string>
#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

// Puts the names of today in the place of old ones, which this version still understands. Returns a
// note for each.
std::vector<std::string> replace_old_names(const Command& command, std::vector<std::string>& words);

}  // namespace rholm::cli
