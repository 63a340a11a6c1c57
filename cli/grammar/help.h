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
// The first screen has one paragraph and the common options; kAll has everything.
enum class HelpExtent { kFirstScreen, kAll };
std::string command_help(const Command& command, HelpExtent extent);

// Returns the command as typed: "rholm expand", or the program alone for a single command.
std::string typed_name(const Command& command);

// Returns "rholm expand SHAPE -o OUT [options]": operands and required options, in lines of at most
// `width` characters. The second and later lines are indented.
std::string usage_line(const Command& command, std::size_t width);

// Returns an option as help shows it: "-o, --output OUT", "--method edge|gauge", "SHAPE".
std::string option_heading(const Option& option);
// Returns the placeholder or the choices of a value: "L", "edge|gauge"; empty for a switch.
std::string value_name(const Option& option);

// Returns the manual page, in the man macros of troff. `date` is YYYY-MM-DD.
std::string man_page(const ProgramText& program, std::span<const Command> commands,
                     const std::string& date);

// Breaks text at spaces into lines of at most `width` characters after `indent` spaces; keeps empty
// lines.
std::string wrap(const std::string& text, std::size_t indent, std::size_t width);

}  // namespace rholm::cli
