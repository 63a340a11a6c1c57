#include "mpi/reconstruct.h"

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/field_bytes.h"
#include "cli/commands/reconstruct.h"
#include "cli/terminal/freed_memory.h"
#include "cli/terminal/interrupt.h"
#include "cluster/collect.h"
#include "cluster/rank_executor.h"
#include "reconstruct/shared_tiles.h"

namespace rholm::mpi {
namespace {

// Data that another rank needs.
struct Part {
  std::filesystem::path folder;
  ReconstructOptions options;
  int threads = 0;
};

std::string bytes_of(const Part& part) {
  ByteWriter writer;
  writer.text(part.folder.string()).number(static_cast<std::uint64_t>(part.threads));
  write_fields(part.options, writer);
  return writer.take();
}

Part part_of(const std::string& bytes) {
  ByteReader packed(bytes);
  Part part;
  part.folder = std::string(packed.text());
  part.threads = static_cast<int>(packed.number());
  read_fields(packed, part.options);
  return part;
}

Reconstruction run(Ranks& ranks, const cli::PointsInput& points, const ReconstructOptions& options,
                   cli::Session& session) {
  Context context = session.context();
  const int wanted = context.threads;
  RankExecutor executor(ranks, wanted);
  context.threads = executor.threads();
  const auto begun = [&](const std::filesystem::path& folder) {
    call(ranks, kReconstructService, bytes_of({folder, options, wanted}));
    if (!options.resume) return;
    ranks.set_hint([folder = folder.string()] {
      return fmt::format("what is done is kept in {}: the same command goes on from there", folder);
    });
  };
  const SharedRun shared{.executor = executor,
                         .begun = begun,
                         .failed = [&](const std::exception_ptr& what) { ranks.fail(what); }};
  return points.cloud ? reconstruct_tiles(*points.cloud, 0, options, shared, context)
                      : reconstruct_tiles(points.file, points.columns, options, shared, context);
}

}  // namespace

cli::Command reconstruct_command(Ranks* ranks) {
  cli::Command command = cli::reconstruct_command_by(
      [ranks](const cli::PointsInput& points, const ReconstructOptions& options,
              cli::Session& session) { return run(*ranks, points, options, session); },
      [ranks] { return ranks->size() > 1; });
  command.description +=
      "\n\nTiles are worked on by all ranks, which leave what they find in a folder of --work-dir "
      "that all of them see; the points are read and holes are closed by rank 0, which also "
      "reconstructs alone what is no more than one tile. The bytes are those of rholm "
      "reconstruct, and either goes on with --resume where the other ended.";
  command.examples = {
      "mpirun -n 16 rholm-mpi reconstruct points.ply --work-dir /scratch -o s.ply",
      "srun rholm-mpi reconstruct points.ply --work-dir /scratch --resume -o s.ply"};
  return command;
}

void serve_reconstruct(Ranks& ranks, const std::string& bytes) {
  const Part part = part_of(bytes);
  Context context;
  RankExecutor executor(ranks, part.threads);
  context.threads = executor.threads();
  context.progress = [](std::string_view, double) { return cli::keep_going(); };
  cli::keep_large_freed_memory();
  help_reconstruct(part.folder, part.options, executor, context);
}

}  // namespace rholm::mpi
