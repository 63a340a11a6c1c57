#include "cli/grammar/run.h"

#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/grammar/help.h"
#include "cli/grammar/old_names.h"
#include "cli/grammar/parse.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/freed_memory.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/session.h"
#include "rholm/error_info.h"

namespace rholm::cli {
namespace {

int exit_code_of(ErrorCode code) {
  const int exit_code = error_info(code).exit_code;
  return code == ErrorCode::kCancelled ? exit_code + interrupting_signal() : exit_code;
}

}  // namespace

Outcome outcome_of(const std::function<int()>& work) {
  try {
    return {work()};
  } catch (const UsageError& error) {
    return {kUsage, error.what()};
  } catch (const Error& error) {
    const bool stopped = error.code() == ErrorCode::kCancelled;
    return {exit_code_of(error.code()),
            stopped ? "interrupted; nothing was written" : error.what()};
  } catch (const std::bad_alloc&) {
    if (memory_limit()) return {kFailure, beyond_memory_limit()};
    return {kFailure, "memory is exhausted; take a lower degree or a mesh with fewer vertices"};
  } catch (const std::filesystem::filesystem_error& error) {
    return {kFailure, fmt::format("{}: {}", error.path1().string(), error.code().message())};
  } catch (const std::exception& error) {
    return {kFailure, fmt::format("unexpected error: {}", error.what())};
  }
}

int run_command(const Command& command, std::span<const std::string> words,
                std::span<const std::string> notes) {
  CommonOptions common;
  try {
    std::vector<std::string> today(words.begin(), words.end());
    const std::vector<std::string> more_notes = replace_old_names(command, today);
    parse(command, today, common);
    Session session(common);
    for (const std::string& note : notes) session.note(note);
    for (const std::string& note : more_notes) session.note(note);
    return command.run(session);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}\nTry '{} --help'.", error.what(), typed_name(command)));
  } catch (const Error& error) {
    // The library's message is general; the command adds its own advice.
    if (error.code() != ErrorCode::kNotStarShaped || command.if_not_star.empty()) throw;
    throw Error(error.code(), fmt::format("{}. {}.", error.what(), command.if_not_star));
  }
}

}  // namespace rholm::cli
