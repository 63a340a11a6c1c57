#include "cli/grammar/help.h"

#include <algorithm>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/terminal/program_name.h"
#include "cli/terminal/session.h"
#include "rholm/version.h"

namespace rholm::cli {
namespace {

constexpr std::size_t kWidth = 80;       // chosen: the narrowest terminal in use
constexpr std::size_t kHelpColumn = 30;  // chosen: most headings fit before it

// Returns "[MESH]", "-o OUT", "SHAPE...".
std::string usage_word(const Option& option) {
  std::string word = option.is_operand() ? option.name
                     : option.letter     ? fmt::format("-{}", option.letter)
                                         : "--" + option.name;
  if (!option.is_operand() && !option.is_switch()) word += " " + value_name(option);
  if (std::holds_alternative<std::vector<std::string>*>(option.target)) word += "...";
  return option.required ? word : "[" + word + "]";
}

std::string option_entry(const Option& option) {
  const std::string heading = "  " + option_heading(option);
  const std::string help = wrap(option.help, kHelpColumn, kWidth);
  if (heading.size() + 2 > kHelpColumn) return heading + "\n" + help;
  return heading + help.substr(heading.size());  // both begin with spaces up to the column
}

// Returns a title and the options below it; empty without options.
std::string option_section(const std::string& title, std::span<const Option> options) {
  std::string text;
  for (const Option& option : options) text += option_entry(option);
  return text.empty() ? "" : "\n" + title + ":\n" + text;
}

}  // namespace

std::string wrap(const std::string& text, std::size_t indent, std::size_t width) {
  const std::string margin(indent, ' ');
  std::string result;
  std::istringstream paragraphs(text);
  for (std::string paragraph; std::getline(paragraphs, paragraph);) {
    std::istringstream words(paragraph);
    std::string line;
    for (std::string word; words >> word;) {
      if (!line.empty() && indent + line.size() + 1 + word.size() > width) {
        result += margin + line + "\n";
        line.clear();
      }
      line += (line.empty() ? "" : " ") + word;
    }
    result += line.empty() ? "\n" : margin + line + "\n";
  }
  return result;
}

namespace {
// Returns "with oneTBB, HDF5\n"; empty for an empty list.
std::string libraries_line(std::string_view word, std::string_view list) {
  return list.empty() ? "" : fmt::format("{} {}\n", word, list);
}
}  // namespace

std::string version_text(const ProgramText& program) {
  // Optional libraries, as CMakeLists.txt lists them.
  return fmt::format("{} {}\n", program.name, kVersion) +
         libraries_line("with", RHOLM_USED_LIBRARIES) +
         libraries_line("without", RHOLM_LEFT_OUT_LIBRARIES);
}

std::string value_name(const Option& option) {
  if (!option.value.empty()) return option.value;
  return option.choices.empty() ? "" : fmt::format("{}", fmt::join(option.choices, "|"));
}

std::string option_heading(const Option& option) {
  if (option.is_operand()) return option.name;
  std::string heading = option.letter ? fmt::format("-{}, ", option.letter) : "";
  heading += "--" + option.name;
  return option.is_switch() ? heading : heading + " " + value_name(option);
}

std::string typed_name(const Command& command) {
  return command.name.empty() ? program_name() : program_name() + " " + command.name;
}

std::string usage_line(const Command& command, std::size_t width) {
  std::string result, line = typed_name(command);
  const std::size_t indent = line.size() + 1;
  std::vector<std::string> words;
  for (const Option& option : command.options) {
    if (option.is_operand() || option.required) words.push_back(usage_word(option));
  }
  words.emplace_back("[options]");
  for (const std::string& word : words) {
    if (line.size() + 1 + word.size() > width) {
      result += line + "\n";
      line = std::string(indent - 1, ' ');
    }
    line += " " + word;
  }
  return result + line;
}

std::string program_help(const ProgramText& program, std::span<const Command> commands) {
  std::string text = fmt::format("{0}: {1}\n\nUsage: {0} {2}\n\nCommands:\n", program.name,
                                 program.summary, program.usage);
  for (const Command& command : commands) {
    if (!command.hidden) text += fmt::format("  {:<12} {}\n", command.name, command.summary);
  }
  text += fmt::format(
      "\n'{0} help COMMAND' explains a command, and '{0} help COMMAND all' all its\n"
      "options. '{0} --version' prints the version.\n"
      "A file named - is standard input or standard output.\n"
      "Exit codes: 0 success, 1 failure (a file cannot be read or written, or memory is\n"
      "missing), 2 wrong command line, 3 input refused, 4 precision not reached,\n"
      "128 + N ended by signal N: 130 by Ctrl-C, 141 if nobody reads standard output.\n"
      "\nExample:\n",
      program.name);
  for (const std::string& example : program.examples) text += "  " + example + "\n";
  return text;
}

std::string command_help(const Command& command, HelpExtent extent) {
  const bool all = extent == HelpExtent::kAll;
  std::string text = fmt::format("{}: {}\n\nUsage: ", typed_name(command), command.summary);
  // The first line of the usage follows "Usage: ".
  std::string usage = usage_line(command, kWidth - 7);
  for (std::size_t at = 0; (at = usage.find('\n', at)) != std::string::npos; at += 8) {
    usage.insert(at + 1, 7, ' ');
  }
  const std::string& about = command.description;
  text += usage + "\n\n" + wrap(all ? about : about.substr(0, about.find("\n\n")), 0, kWidth);
  text += option_section("Operands", operands_of(command));
  std::size_t more = 0;
  for (const GroupInfo& info : kGroups) {
    const std::vector<Option> options = described_options(command, info.group);
    if (all || info.on_first_screen) {
      text += option_section(info.title, options);
    } else {
      more += options.size();
    }
  }
  text += command.examples.size() == 1 ? "\nExample:\n" : "\nExamples:\n";
  for (const std::string& example : command.examples) text += "  " + example + "\n";
  if (all) return text;
  // Every command has two common options, so that `more` is at least two.
  return text + fmt::format("\n{} --help all shows {} more options.\n", typed_name(command), more);
}

}  // namespace rholm::cli
