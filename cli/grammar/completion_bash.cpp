#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/grammar/completion.h"

namespace rholm::cli {
namespace {

// The script needs neither bash-completion nor extended globs. It offers a file if its extension
// fits, or any file if no extension is listed.
constexpr const char* kHead =
    R"(# bash completion for @program@, written by '@program@ completion bash'

_@function@_files()
{
    local file
    compopt -o filenames 2>/dev/null
    while IFS= read -r file; do
        if [[ -z $1 || -d $file || ${file,,} =~ \.($1)$ ]]; then COMPREPLY+=("$file"); fi
    done < <(compgen -f -- "$cur")
    if [[ ${#COMPREPLY[@]} -eq 0 ]]; then mapfile -t COMPREPLY < <(compgen -f -- "$cur"); fi
}

_@function@_words()
{
    mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur")
}

_@function@()
{
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]}
    COMPREPLY=()
    # --option=value comes as three words.
    if [[ $cur == "=" ]]; then
        cur=
    elif [[ $prev == "=" && $COMP_CWORD -gt 2 ]]; then
        prev=${COMP_WORDS[COMP_CWORD-2]}
    fi
)";

std::string files_call(Offer offer) {
  return fmt::format("_@function@_files '{}'", fmt::join(offered_extensions(offer), "|"));
}

// Returns the action for the word after an option, or for an operand.
std::string action(const Option& option) {
  if (!option.choices.empty()) {
    return fmt::format("_@function@_words '{}'", fmt::join(option.choices, " "));
  }
  return option.offer == Offer::kNothing ? "" : files_call(option.offer);
}

std::string value_cases(const Command& command) {
  std::string text;
  for (const Option& option : offered_options(command)) {
    if (option.is_operand() || option.is_switch()) continue;
    text += fmt::format("    '{} --{}'", command.name, option.name);
    if (option.letter) text += fmt::format("|'{} -{}'", command.name, option.letter);
    text += fmt::format(") {}; return ;;\n", action(option).empty() ? ":" : action(option));
  }
  return text;
}

std::string command_case(const Command& command) {
  std::string words, operand;
  for (const Option& option : offered_options(command)) {
    if (option.is_operand()) {
      if (operand.empty()) operand = action(option);
    } else {
      if (option.letter) words += fmt::format("-{} ", option.letter);
      words += fmt::format("--{} ", option.name);
    }
  }
  words.pop_back();
  return fmt::format(
      "    {})\n        if [[ $cur == -* ]]; then _@function@_words '{}'; else {}; fi ;;\n",
      command.name, words, operand.empty() ? ":" : operand);
}

}  // namespace

std::string bash_completion(const std::string& program, std::span<const Command> commands) {
  std::string names, values, cases;
  for (const Command& command : offered_commands(commands)) {
    names += command.name + " ";
    values += value_cases(command);
    cases += command_case(command);
  }
  return of_program(
      std::string(kHead) +
          fmt::format(
              "    if [[ $COMP_CWORD -eq 1 ]]; then\n"
              "        _@function@_words '{0}help --help --version'\n        return\n    fi\n"
              "    case \"$command $prev\" in\n{1}    esac\n"
              "    case $command in\n{2}    help) _@function@_words '{0}' ;;\n    esac\n}}\n\n"
              "complete -F _@function@ @program@\n",
              names, values, cases),
      program);
}

}  // namespace rholm::cli
