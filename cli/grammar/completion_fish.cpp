#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/grammar/completion.h"

namespace rholm::cli {
namespace {

std::string quoted(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\'' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return fmt::format("'{}'", escaped);
}

std::string files(Offer offer) {
  const std::vector<std::string> extensions = offered_extensions(offer);
  if (extensions.empty()) return "-F";
  return fmt::format("-k -a '(__fish_complete_suffix .{})'", fmt::join(extensions, " ."));
}

// Returns the part of a line that lists the values.
std::string values(const Option& option) {
  if (!option.choices.empty())
    return "-a " + quoted(fmt::format("{}", fmt::join(option.choices, " ")));
  return option.offer == Offer::kNothing ? "" : files(option.offer);
}

std::string option_line(const Command& command, const Option& option) {
  std::string text =
      fmt::format("complete -c @program@ -n '__fish_seen_subcommand_from {}'", command.name);
  if (option.is_operand()) {
    return values(option).empty() ? "" : text + " " + values(option) + "\n";
  }
  text += " -l " + option.name;
  if (option.letter) text += fmt::format(" -s {}", option.letter);
  if (!option.is_switch()) text += option.offer == Offer::kNothing ? " -x" : " -r";
  if (!option.is_switch()) text += " " + values(option);
  return text + " -d " + quoted(first_clause(option.help)) + "\n";
}

}  // namespace

std::string fish_completion(const std::string& program, std::span<const Command> commands) {
  std::string text =
      "# fish completion for @program@, written by '@program@ completion fish'\n\ncomplete -c "
      "@program@ -f\n";
  for (const Command& command : offered_commands(commands)) {
    text += fmt::format("complete -c @program@ -n __fish_use_subcommand -a {} -d {}\n",
                        command.name, quoted(command.summary));
  }
  text +=
      "complete -c @program@ -n __fish_use_subcommand -a help -d 'What @program@ or a command "
      "does'\n"
      "complete -c @program@ -n __fish_use_subcommand -l help -d 'What @program@ does'\n"
      "complete -c @program@ -n __fish_use_subcommand -l version -d 'The version'\n";
  for (const Command& command : offered_commands(commands)) {
    text += '\n';
    for (const Option& option : offered_options(command)) text += option_line(command, option);
  }
  return of_program(std::move(text), program);
}

}  // namespace rholm::cli
