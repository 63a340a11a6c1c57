#include "cli/program.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/grammar/help.h"
#include "cli/grammar/old_names.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/run.h"
#include "cli/grammar/suggest.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/program_name.h"
#include "cli/terminal/session.h"
#include "rholm/context.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

int print(const std::string& text, std::FILE* where = stdout) {
  std::fwrite(text.data(), 1, text.size(), where);
  return where == stdout ? kDone : kUsage;
}

const Command* find_command(std::span<const Command> commands, const std::string& name) {
  const auto found = std::find_if(commands.begin(), commands.end(),
                                  [&](const Command& command) { return command.name == name; });
  return found == commands.end() ? nullptr : &*found;
}

const Command& command_of(std::span<const Command> commands, const std::string& name) {
  if (const Command* command = find_command(commands, name)) return *command;
  std::vector<std::string> names;
  for (const Command& command : commands) {
    if (!command.hidden) names.push_back(command.name);
  }
  std::string meant = command_hint(name);
  if (meant.empty()) meant = did_you_mean(name, names);
  throw UsageError(
      fmt::format("there is no command '{}'{}\nTry '{} help'.", name, meant, program_name()));
}

// Returns how much help is asked for: nothing, "--help", or "--help all".
std::optional<HelpExtent> wanted_help(std::span<const std::string> words) {
  const auto help = std::find_if(words.begin(), words.end(), [](const std::string& word) {
    return word == "--help" || word == "-h";
  });
  if (help == words.end()) return std::nullopt;
  const bool all = help + 1 != words.end() && *(help + 1) == "all";
  return all ? HelpExtent::kAll : HelpExtent::kFirstScreen;
}

int dispatch(const Command& command, std::span<const std::string> words,
             std::span<const std::string> notes = {}) {
  if (const auto extent = wanted_help(words)) return print(command_help(command, *extent));
  const CancelScope scope(keep_going);
  return run_command(command, words, notes);
}

int dispatch(const ProgramText& program, std::span<const Command> commands,
             std::vector<std::string> words) {
  if (words.empty()) return print(program_help(program, commands), stderr);
  const std::vector<std::string> notes = replace_old_command(words);
  const std::string& first = words.front();
  const auto rest = std::span<const std::string>(words).subspan(1);
  if (first == "--version") return print(version_text(program));
  if (first == "--help" || first == "-h") return print(program_help(program, commands));
  if (first == "help") {
    std::vector<std::string> name(rest.begin(), rest.end());
    replace_old_command(name);
    if (name.empty()) return print(program_help(program, commands));
    const bool all = name.size() > 1 && name[1] == "all";
    return print(command_help(command_of(commands, name.front()),
                              all ? HelpExtent::kAll : HelpExtent::kFirstScreen));
  }
  if (first.starts_with('-')) {
    throw UsageError(
        fmt::format("the command comes first, then its options: {0} COMMAND ... {1}; '{0} help' "
                    "lists the commands",
                    program.name, first));
  }
  return dispatch(command_of(commands, first), rest, notes);
}

// Flushes standard output: printed text may be in a buffer, and the disk may be full.
int flushed(int code) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
  throw Error(ErrorCode::kIo, "standard output cannot be written: the report is incomplete");
}

}  // namespace

Outcome run_program(const ProgramText& program, const std::vector<Command>& commands,
                    const std::vector<std::string>& words) {
  return outcome_of([&] { return flushed(dispatch(program, commands, words)); });
}

Outcome run_program(const Command& command, const std::vector<std::string>& words) {
  return outcome_of([&] { return flushed(dispatch(command, words)); });
}

int run_program(const std::vector<std::string>& words) {
  const Outcome outcome = run_program(rholm_text(), all_commands(), words);
  if (!outcome.message.empty()) print_error(outcome.message);
  return outcome.code;
}

}  // namespace rholm::cli
