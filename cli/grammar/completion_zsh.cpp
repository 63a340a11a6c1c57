#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/grammar/completion.h"

namespace rholm::cli {
namespace {

// Escapes text for single quotes, and for brackets and colons of _arguments.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else if (c == '[' || c == ']' || c == ':' || c == '\\') {
      result += std::string("\\") + c;
    } else {
      result += c;
    }
  }
  return result;
}

std::string action(const Option& option) {
  if (!option.choices.empty()) return fmt::format("({})", fmt::join(option.choices, " "));
  if (option.offer == Offer::kNothing) return " ";
  const std::vector<std::string> extensions = offered_extensions(option.offer);
  if (extensions.empty()) return "_files";
  return fmt::format("_files -g \"*.(#i)({})(-.)\"", fmt::join(extensions, "|"));
}

// Returns one quoted specification of _arguments.
std::string specification(const Option& option, int operand) {
  const std::string what = escaped(first_clause(option.help));
  const bool many = std::holds_alternative<std::vector<std::string>*>(option.target);
  if (option.is_operand()) {
    return fmt::format("'{}:{}:{}'", many ? "*" : fmt::format("{}", operand), escaped(option.name),
                       action(option));
  }
  const std::string value =
      option.is_switch()
          ? ""
          : fmt::format(":{}:{}", escaped(option.value.empty() ? option.name : option.value),
                        action(option));
  if (option.letter) {
    return fmt::format("'(-{0} --{1})'{{-{0},--{1}}}'[{2}]{3}'", option.letter, option.name, what,
                       value);
  }
  return fmt::format("'{}--{}{}[{}]{}'", many ? "*" : "", option.name,
                     option.is_switch() ? "" : "=", what, value);
}

std::string command_case(const Command& command) {
  std::string text = fmt::format("        {})\n          _arguments -s", command.name);
  int operand = 0;
  for (const Option& option : offered_options(command)) {
    operand += option.is_operand();
    text += " \\\n            " + specification(option, operand);
  }
  return text + " && ret=0 ;;\n";
}

}  // namespace

std::string zsh_completion(const std::string& program, std::span<const Command> commands) {
  std::string names, cases;
  for (const Command& command : offered_commands(commands)) {
    names += fmt::format("    '{}:{}'\n", command.name, escaped(command.summary));
    cases += command_case(command);
  }
  return of_program(fmt::format(R"(#compdef @program@
# zsh completion for @program@, written by '@program@ completion zsh'

_@function@() {{
  local curcontext="$curcontext" state line ret=1
  local -a commands
  commands=(
{}    'help:What @program@ or a command does'
  )
  _arguments -C '(- *)--help[what it does]' '(- *)--version[the version]' \
    '1: :->command' '*:: :->argument' && ret=0
  case $state in
    command)
      _describe -t commands '@program@ command' commands && ret=0 ;;
    argument)
      case $words[1] in
{}        help)
          _describe -t commands '@program@ command' commands && ret=0 ;;
      esac ;;
  esac
  return ret
}}

if [[ $funcstack[1] == _@program@ ]]; then
  _@function@ "$@"
else
  compdef _@function@ @program@
fi
)",
                                names, cases),
                    program);
}

}  // namespace rholm::cli
