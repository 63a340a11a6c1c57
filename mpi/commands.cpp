#include "mpi/commands.h"

#include <cstdio>

#include "cli/commands/commands.h"
#include "cli/terminal/session.h"
#include "mpi/analyze.h"
#include "mpi/batch.h"
#include "mpi/compare.h"
#include "mpi/reconstruct.h"

namespace rholm::mpi {
namespace {

using cli::Command;

Command over_ranks(Command command, Ranks* ranks, const std::shared_ptr<RankOptions>& options) {
  append(command.options, rank_options(*options));
  command.run = [run = std::move(command.run), ranks, options](cli::Session& session) {
    ranks->set_patience(options->patience);
    return run(session);
  };
  return command;
}

// Returns the commands for descriptions only.
std::vector<Command> own_commands() { return commands(nullptr, std::make_shared<RankOptions>()); }

Command man_page_command() {
  return cli::man_page_command("rholm-mpi", [](const std::string& date) {
    return cli::man_page(about(), own_commands(), date);
  });
}

}  // namespace

std::vector<Command> commands(Ranks* ranks, const std::shared_ptr<RankOptions>& options) {
  return {over_ranks(analyze_command(ranks), ranks, options),
          over_ranks(batch_command(ranks), ranks, options),
          over_ranks(compare_command(ranks, options), ranks, options),
          over_ranks(reconstruct_command(ranks), ranks, options),
          cli::completion_command("rholm-mpi", own_commands),
          man_page_command()};
}

Services services() {
  return {{kAnalyzeService, analyze_service()},
          {kBatchService, serve_batch},
          {kCompareService, serve_compare},
          {kReconstructService, serve_reconstruct}};
}

cli::ProgramText about() {
  return {.name = "rholm-mpi",
          .summary = "commands of rholm on many processors and machines, by MPI",
          .usage = "COMMAND ... [--threads N] [--quiet] [--patience S] [--timings]",
          .examples = {"mpirun -n 16 rholm-mpi analyze huge.ply --degree 480 -o huge.h5",
                       "mpirun -n 16 rholm-mpi batch shapes.csv -o results.h5 -- --degree 32"},
          .description =
              "The same commands as those of rholm, with the same results to the byte, on as many "
              "ranks as mpirun or srun start: rank 0 reads the command line, and hands work to all "
              "ranks. --threads is of each rank; by default each has its share of the processors "
              "of its machine that it may use.\n\nIf a rank fails, one message says which and why, "
              "and all ranks end with the same code. A rank that is silent, or at work without "
              "progress, for longer than --patience ends the run in the same way."};
}

}  // namespace rholm::mpi
