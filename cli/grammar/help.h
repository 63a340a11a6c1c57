// Texts made from the descriptions of the commands. Layer: cli.
#pragma once

#include <span>
#include <string>

#include "cli/grammar/command.h"

namespace rholm::cli {

std::string version_text();
std::string program_help(std::span<const Command> commands);
std::string command_help(const Command& command);

// "rholm analyze SHAPE --degree L [--method edge|gauge] -o OUT", broken into lines of at most
// `width` letters, the second and later ones indented.
std::string usage_line(const Command& command, std::size_t width);

// An option as help shows it: "-o, --output OUT", "--method edge|gauge", "SHAPE".
std::string option_heading(const Option& option);

// The manual page, in the man macros of troff. `date` as YYYY-MM-DD.
std::string man_page(std::span<const Command> commands, const std::string& date);

// Breaks text at spaces into lines of at most `width` letters after `indent` spaces; empty lines
// stay.
std::string wrap(const std::string& text, std::size_t indent, std::size_t width);

}  // namespace rholm::cli
