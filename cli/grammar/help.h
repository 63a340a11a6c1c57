// Texts made from the descriptions of the commands. Layer: cli.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

// Description of a program, besides its commands.
struct ProgramText {
  std::string name, summary;
  std::string usage;                  // text after the name
  std::vector<std::string> examples;  // whole command lines
  std::string description;            // paragraphs separated by empty lines
};

std::string version_text(const ProgramText& program);
std::string program_help(const ProgramText& program, std::span<const Command> commands);
std::string command_help(const Command& command);

// Returns the command as typed: "rholm analyze", or the program alone for a single command.
std::string typed_name(const Command& command);

// Returns "rholm analyze SHAPE --degree L [--method edge|gauge] -o OUT" in lines of at most `width`
// characters; the second and later lines are indented.
std::string usage_line(const Command& command, std::size_t width);

// Returns an option as help shows it: "-o, --output OUT", "--method edge|gauge", "SHAPE".
std::string option_heading(const Option& option);

// Returns the manual page, in the man macros of troff. `date` is YYYY-MM-DD.
std::string man_page(const ProgramText& program, std::span<const Command> commands,
                     const std::string& date);

// Breaks text at spaces into lines of at most `width` characters after `indent` spaces; keeps empty
// lines.
std::string wrap(const std::string& text, std::size_t indent, std::size_t width);

}  // namespace rholm::cli
