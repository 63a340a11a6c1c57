// Names of commands and options in the previous version. Layer: cli.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

// Replaces old names, which this version still understands, by present names. Returns a note for
// each.
std::vector<std::string> replace_old_names(const Command& command, std::vector<std::string>& words);

// Replaces an old name of a command, the first of the words. Returns the notes.
std::vector<std::string> replace_old_command(std::vector<std::string>& words);

// Return "; 'rholm compress' makes an atlas of caps" for a word of another program or version that
// names something this program calls differently; empty for other words.
std::string command_hint(std::string_view word);
std::string option_hint(std::string_view word);

}  // namespace rholm::cli
