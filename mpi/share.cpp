#include "mpi/share.h"

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "cli/files/inputs.h"
#include "cli/files/paths.h"
#include "cli/grammar/parse.h"
#include "cli/terminal/interrupt.h"
#include "cluster/collect.h"
#include "cluster/pack.h"
#include "cluster/tasks.h"
#include "rholm/context.h"
#include "rholm/error.h"

namespace rholm::mpi {
namespace {

// A task with its result or, of invalid input, what is wrong with it.
DoTask guarded(const DoSharedTask& work) {
  return [&work](std::uint64_t task, int) {
    const CancelScope scope(cli::keep_going);
    try {
      return Packer().number(1).text(work(task)).take();
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kInvalidInput) throw;
      return Packer().number(0).text(error.what()).take();
    }
  };
}

}  // namespace

ShareTasks share_with_all(Ranks& ranks, int threads) {
  return [&ranks, threads](const SharedTasks& tasks, const DoSharedTask& here,
                           const TakeSharedResult& take) {
    std::optional<std::string> fault;
    lead_tasks(ranks, OrderedTasks{.count = tasks.count, .dealt = tasks.dealt},
               threads_here(ranks, threads), guarded(here),
               [&](std::uint64_t task, const std::string& bytes) {
                 Unpacker result(bytes);
                 const bool is_done = result.number() != 0;
                 if (is_done) {
                   take(task, std::string(result.text()));
                 } else {
                   fault = result.text();
                 }
                 return is_done;
               });
    if (fault) throw Error(ErrorCode::kInvalidInput, *fault);
  };
}

int threads_here(const Ranks& ranks, int wanted) {
  return wanted > 0 ? wanted : ranks.processors();
}

ShareTasks share_over(Ranks& ranks, const std::string& name, const std::string& subject,
                      int threads) {
  return [&ranks, name, subject, threads](const SharedTasks& tasks, const DoSharedTask& here,
                                          const TakeSharedResult& take) {
    call(ranks, name,
         Packer().number(static_cast<std::uint64_t>(threads)).text(subject).text(tasks.job).take());
    share_with_all(ranks, threads)(tasks, here, take);
  };
}

SharedCall shared_call(const std::string& bytes) {
  Unpacker packed(bytes);
  SharedCall call;
  call.threads = static_cast<int>(packed.number());
  call.subject = packed.text();
  call.job = packed.text();
  return call;
}

void serve_shared(Ranks& ranks, int threads, const DoSharedTask& work) {
  serve_tasks(ranks, threads_here(ranks, threads), guarded(work));
}

void check_input(const Ranks& ranks, const std::string& path) {
  std::error_code none;
  const bool is_stream = path == "-" || (std::filesystem::exists(path, none) &&
                                         !std::filesystem::is_regular_file(path, none));
  if (ranks.size() == 1 || !is_stream) return;
  throw cli::UsageError(fmt::format(
      "{} can be read by one rank alone, and there are {}: give the name of a file that "
      "all of them see",
      cli::display_name(path), ranks.size()));
}

}  // namespace rholm::mpi
