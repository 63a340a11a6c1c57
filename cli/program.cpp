#include "cli/program.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <new>
#include <span>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/grammar/help.h"
#include "cli/grammar/parse.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/session.h"
#include "rholm/context.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

int exit_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kIo:
    case ErrorCode::kOutOfMemory:
      return kFailure;
    case ErrorCode::kInvalidInput:
    case ErrorCode::kUnsupported:
    case ErrorCode::kNotStarShaped:
      return kRefused;
    case ErrorCode::kNotConverged:
      return kNotConverged;
    case ErrorCode::kCancelled:
      return 128 + interrupting_signal();
  }
  return kFailure;
}

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
  throw UsageError(fmt::format("there is no command '{}'; 'rholm help' lists them", name));
}

bool asks_for_help(std::span<const std::string> words) {
  return std::any_of(words.begin(), words.end(),
                     [](const std::string& word) { return word == "--help" || word == "-h"; });
}

int run_command(const Command& command, std::span<const std::string> words) {
  CommonOptions common;
  try {
    parse(command, words, common);
    Session session(common);
    return command.run(session);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}\nTry 'rholm {} --help'.", error.what(), command.name));
  } catch (const Error& error) {
    // The library speaks of ideas; what they are called here, the command knows.
    if (error.code() != ErrorCode::kNotStarShaped || command.if_not_star.empty()) throw;
    throw Error(error.code(), fmt::format("{} ({})", error.what(), command.if_not_star));
  }
}

int dispatch(std::span<const std::string> words) {
  const std::vector<Command> commands = all_commands();
  if (words.empty()) return print(program_help(commands), stderr);
  const std::string& first = words.front();
  const auto rest = words.subspan(1);
  if (first == "--version") return print(version_text());
  if (first == "--help" || first == "-h") return print(program_help(commands));
  if (first == "help") {
    return print(rest.empty() ? program_help(commands)
                              : command_help(command_of(commands, rest.front())));
  }
  if (first.starts_with('-')) {
    throw UsageError(fmt::format(
        "the command comes first, then its options: rholm COMMAND ... {}; 'rholm help' lists the "
        "commands",
        first));
  }
  const Command& command = command_of(commands, first);
  if (asks_for_help(rest)) return print(command_help(command));
  const CancelScope scope([] { return interrupting_signal() == 0; });
  return run_command(command, rest);
}

// What was printed may still wait in a buffer, and the disk may be full.
int flushed(int code) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
  print_error("standard output cannot be written: the report is incomplete");
  return kFailure;
}

}  // namespace

int run_program(const std::vector<std::string>& words) {
  try {
    return flushed(dispatch(words));
  } catch (const UsageError& error) {
    print_error(error.what());
    return kUsage;
  } catch (const Error& error) {
    const bool stopped = error.code() == ErrorCode::kCancelled;
    print_error(stopped ? "interrupted; nothing was written" : error.what());
    return exit_code_of(error.code());
  } catch (const std::bad_alloc&) {
    print_error("there is not enough memory for this; ask for a lower degree or fewer vertices");
    return kFailure;
  } catch (const std::filesystem::filesystem_error& error) {
    print_error(fmt::format("{}: {}", error.path1().string(), error.code().message()));
    return kFailure;
  } catch (const std::exception& error) {
    print_error(fmt::format("unexpected: {}", error.what()));
    return kFailure;
  }
}

}  // namespace rholm::cli
