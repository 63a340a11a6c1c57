#include "mpi/batch.h"

#include <filesystem>
#include <memory>
#include <mutex>

#include <fmt/format.h>

#include "base/bytes.h"
#include "cli/batch/job.h"
#include "cli/batch/outputs_folder.h"
#include "cli/batch/workers.h"
#include "cli/commands/batch.h"
#include "cli/terminal/interrupt.h"
#include "cluster/collect.h"
#include "cluster/rank_executor.h"
#include "model/batch/row_bytes.h"
#include "rholm/error.h"

namespace rholm::mpi {
namespace {

// Returns the bytes from which another rank makes the same job.
std::string bytes_of(const cli::BatchJob& job, const std::string& rows, int threads) {
  const cli::BatchOptions& o = job.options;
  return ByteWriter()
      .number(static_cast<std::uint64_t>(threads))
      .texts({o.manifest, o.output, o.command, o.shard, o.outputs})
      .texts(o.words)
      .number(o.no_times ? 1 : 0)
      .text({job.manifest_text.data(), job.manifest_text.size()})
      .text(rows)
      .take();
}

struct Part {
  cli::BatchJob job;
  std::vector<std::size_t> rows;
  int threads = 0;
};

Part part_of(const std::string& bytes) {
  ByteReader packed(bytes);
  Part part;
  part.threads = static_cast<int>(packed.number());
  const std::vector<std::string> texts = packed.texts();
  cli::BatchOptions o;
  o.manifest = texts.at(0), o.output = texts.at(1), o.command = texts.at(2);
  o.shard = texts.at(3), o.outputs = texts.at(4);
  o.words = packed.texts();
  o.no_times = packed.number() != 0;
  const std::string_view text = packed.text();
  part.job = make_job(o, cli::commands_for_batches(), {text.begin(), text.end()});
  for (std::string_view rows = packed.text(); !rows.empty(); rows.remove_prefix(8)) {
    part.rows.push_back(get_u64(rows));
  }
  return part;
}

// Progress, and the way to continue after an interruption as long as the journal exists.
struct Progress {
  std::mutex mutex;
  std::string journal;
  std::size_t done = 0, all = 0;

  std::string hint() {
    const std::lock_guard lock(mutex);
    std::error_code error;
    if (!std::filesystem::exists(journal, error)) return {};
    return fmt::format("{} of {} rows are kept in {}: the same command goes on from there", done,
                       all, journal);
  }
  void set_done(std::size_t rows) {
    const std::lock_guard lock(mutex);
    done = rows;
  }
};

bool run_rows(Ranks& ranks, const cli::BatchJob& job, BatchJournal& journal,
              cli::Session& session) {
  const auto progress = std::make_shared<Progress>();
  progress->journal = job.options.output + ".journal";
  progress->all = job.rows.size();
  progress->done = journal.done();
  ranks.set_hint([progress] { return progress->hint(); });
  const int threads = session.context().threads;
  RankExecutor executor(ranks, threads, [&](const Parts& parts) {
    call(ranks, kBatchService, bytes_of(job, parts.input, threads));
  });
  cli::work_rows(job, rows_to_do(job, journal), journal, executor, session,
                 [&] { progress->set_done(journal.done()); });
  return true;
}

}  // namespace

cli::Command batch_command(Ranks* ranks) {
  cli::Command command = cli::batch_command_by(
      [ranks](const cli::BatchJob& job, BatchJournal& journal, cli::Session& session) {
        return run_rows(*ranks, job, journal, session);
      });
  command.description +=
      "\n\nRank 0 hands rows out to all ranks, keeps the journal and writes the results, which are "
      "those of rholm batch; either goes on with the journal of the other. Paths mean the same on "
      "all machines.";
  command.examples = {"mpirun -n 4 rholm-mpi batch shapes.csv -o results.h5 -- --degree 16",
                      "srun rholm-mpi batch shapes.csv --command info -o info.csv"};
  return command;
}

void serve_batch(Ranks& ranks, const std::string& bytes) {
  const Part part = part_of(bytes);
  const TemporaryFolder scratch = cli::scratch_folder();
  RankExecutor(ranks, part.threads).run({}, row_work(part.job, part.rows, scratch), {});
}

}  // namespace rholm::mpi
