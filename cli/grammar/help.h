// Texts made from the descriptions of the commands. Layer: cli.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

// What a program says of itself besides its commands.
struct ProgramText {
  std::string name, summary;
  std::string usage;                  // what follows the name
  std::vector<std::string> examples;  // whole command lines
  std::string description;            // paragraphs separated by empty lines
};

std::string version_text(const ProgramText& program);
std::string program_help(const ProgramText& program, std::span<const Command> commands);
std::string command_help(const Command& command);

// As it is typed: "rholm analyze", or the program alone where it is one command without a name.
std::string typed_name(const Command& command);

// "rholm analyze SHAPE --degree L [--method edge|gauge] -o OUT", broken into lines of at most
// `width` letters, the second and later ones indented.
std::string usage_line(const Command& command, std::size_t width);

// An option as help shows it: "-o, --output OUT", "--method edge|gauge", "SHAPE".
std::string option_heading(const Option& option);

// The manual page, in the man macros of troff. `date` as YYYY-MM-DD.
std::string man_page(const ProgramText& program, std::span<const Command> commands,
                     const std::string& date);

// Breaks text at spaces into lines of at most `width` letters after `indent` spaces; empty lines
// stay.
std::string wrap(const std::string& text, std::size_t indent, std::size_t width);

}  // namespace rholm::cli
