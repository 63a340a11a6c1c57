// The program rholm-mpi. Layer: mpi.
#include <csignal>
#include <memory>

#include <fmt/format.h>

#include "cli/program.h"
#include "cli/terminal/bus_error.h"
#include "cli/terminal/descriptors.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/freed_memory.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/program_name.h"
#include "cli/terminal/session.h"
#include "cluster/collect.h"
#include "cluster/ranks.h"
#include "mpi/commands.h"
#include "rholm/error.h"
#include "rholm/file.h"

namespace rholm::mpi {
namespace {

Ending ending_of(const std::exception_ptr& what) {
  const cli::Outcome outcome = cli::outcome_of([&]() -> int { std::rethrow_exception(what); });
  return {outcome.code, outcome.message};
}

void tell_totals(const RankTotals& totals) {
  cli::print_note(
      fmt::format("{}: {:.2f} s of processors, {:.2f} s of the busiest; {:.3f} MB in {} messages",
                  totals.ranks == 1 ? "1 rank" : fmt::format("{} ranks", totals.ranks),
                  totals.cpu_seconds, totals.longest_cpu_seconds,
                  1e-6 * static_cast<double>(totals.traffic.bytes), totals.traffic.messages));
}

RanksProgram program(const RankOptions& options) {
  return {.progress = cli::questions_asked,
          .keep_going = cli::keep_going,
          .interrupted = cli::interrupting_signal,
          .stop =
              [](int code) {
                // For any reason: computations end as if they were interrupted.
                if (code != 0) cli::interrupt(SIGTERM);
              },
          .error = cli::print_error,
          .ended =
              [&options](const RankTotals& totals) {
                if (options.timings) tell_totals(totals);
              },
          .discard = discard_unfinished_files,
          .ending_of = ending_of,
          .failure = cli::kFailure};
}

int run(const std::vector<std::string>& words) {
  const auto options = std::make_shared<RankOptions>();
  options->words = words;
  Ranks ranks(program(*options));
  // Installed after MPI, which has its own handlers.
  cli::install_signal_handlers();
  cli::install_bus_error_handler();
  return ranks.run(
      [&](Ranks& all) {
        const cli::Outcome outcome = cli::run_program(about(), commands(&all, options), words);
        return Ending{outcome.code, outcome.message};
      },
      [](Ranks& all) { serve_calls(all, services()); });
}

}  // namespace
}  // namespace rholm::mpi

int main(int argc, char** argv) {
  using namespace rholm;
  cli::fill_standard_descriptors();
  cli::keep_freed_memory();
  cli::set_program_name("rholm-mpi");
  const std::vector<std::string> words(argv + 1, argv + argc);
  const bool needs_ranks =
      words.empty() || (words.front() != "man-page" && words.front() != "completion");
  const cli::Outcome outcome = cli::outcome_of([&] {
    if (needs_ranks) return mpi::run(words);
    const auto options = std::make_shared<mpi::RankOptions>();
    const cli::Outcome said =
        cli::run_program(mpi::about(), mpi::commands(nullptr, options), words);
    if (!said.message.empty()) cli::print_error(said.message);
    return said.code;
  });
  if (!outcome.message.empty()) cli::print_error(outcome.message);
  return outcome.code;
}
