// The manual page, written in troff's man macros.
#include <algorithm>

#include <fmt/format.h>

#include "cli/grammar/help.h"
#include "cli/terminal/program_name.h"
#include "cli/terminal/session.h"
#include "rholm/version.h"

namespace rholm::cli {
namespace {

// Escapes text for troff: backslashes, hyphens that must stay hyphens, leading dots.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n')) {
      result += std::string("\\&") + c;
    } else {
      result += c;
    }
  }
  return result;
}

std::string paragraphs(const std::string& text) {
  std::string result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find("\n\n", begin), text.size());
    if (begin > 0) result += ".PP\n";
    result += escaped(wrap(text.substr(begin, end - begin), 0, 78));
    begin = end + 2;
  }
  return result;
}

std::string option_items(const std::vector<Option>& options) {
  std::string text;
  for (const Option& option : options) {
    text += fmt::format(".TP\n\\fB{}\\fR\n{}.\n", escaped(option_heading(option)),
                        escaped(option.help));
  }
  return text;
}

// --threads and --quiet have a section of their own.
bool is_common(const Option& option) { return option.name == "threads" || option.name == "quiet"; }

std::string command_section(const Command& command) {
  std::string text = fmt::format(".SS {} {}\n", escaped(program_name()), command.name);
  text += ".nf\n" + escaped(usage_line(command, 76)) + "\n.fi\n.PP\n";
  text += escaped(command.summary) + ".\n.PP\n" + paragraphs(command.description);
  text += option_items(operands_of(command));
  for (const GroupInfo& info : kGroups) {
    std::vector<Option> options = described_options(command, info.group);
    std::erase_if(options, is_common);
    if (!options.empty())
      text += fmt::format(".PP\n\\fI{}\\fR\n", info.title) + option_items(options);
  }
  text += ".PP\nExample:\n.PP\n.nf\n";
  for (const std::string& example : command.examples) text += escaped("    " + example) + "\n";
  return text + ".fi\n";
}

}  // namespace

std::string man_page(const ProgramText& program, std::span<const Command> commands,
                     const std::string& date) {
  CommonOptions common;
  std::string upper = program.name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  const std::string name = escaped(program.name);
  std::string text = fmt::format(".TH {} 1 \"{}\" \"{} {}\" \"User Commands\"\n", escaped(upper),
                                 date, name, kVersion);
  text += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B {}\n", name, escaped(program.summary),
                      name);
  text +=
      ".I COMMAND\n\\&... [\\fB\\-\\-threads\\fR \\fIN\\fR] "
      "[\\fB\\-\\-quiet\\fR]\n"
      ".SH DESCRIPTION\n";
  text += paragraphs(program.description);
  text += ".SH OPTIONS OF EVERY COMMAND\n";
  text += option_items(common_options(common));
  text +=
      ".TP\n\\fB\\-\\-help\\fR [\\fBall\\fR]\nPrints what the command does, its common options and "
      "examples; with \\fBall\\fR all options.\n";
  text += ".SH COMMANDS\n";
  for (const Command& command : commands) {
    if (!command.hidden) text += command_section(command);
  }
  text +=
      ".SH EXIT STATUS\n"
      ".TP\n0\nSuccess.\n"
      ".TP\n1\nFailure: a file cannot be read or written, or memory is missing.\n"
      ".TP\n2\nThe command line is wrong.\n"
      ".TP\n3\nThe input is malformed, not supported, or not star\\-shaped.\n"
      ".TP\n4\nA precision was not reached.\n"
      ".TP\n128 + N\nEnded by signal N: 130 by Ctrl\\-C. Existing files stay complete.\n"
      ".TP\n141\nThe reader of standard output has ended (SIGPIPE).\n"
      ".SH ENVIRONMENT\n"
      ".TP\n\\fBNO_COLOR\\fR\nIf set and not empty, messages have no colours.\n";
  return text;
}

}  // namespace rholm::cli
