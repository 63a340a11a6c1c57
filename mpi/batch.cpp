#include "mpi/batch.h"

#include <filesystem>
#include <memory>
#include <mutex>

#include <fmt/format.h>

#include "cli/batch/job.h"
#include "cli/batch/outputs_folder.h"
#include "cli/batch/row.h"
#include "cli/batch/workers.h"
#include "cli/commands/batch.h"
#include "cli/terminal/interrupt.h"
#include "cluster/collect.h"
#include "cluster/pack.h"
#include "cluster/tasks.h"
#include "model/batch/row_bytes.h"
#include "mpi/share.h"
#include "rholm/error.h"

namespace rholm::mpi {
namespace {

// What another rank needs to make the job anew.
std::string bytes_of(const cli::BatchJob& job, int threads) {
  const cli::BatchOptions& o = job.options;
  return Packer()
      .number(static_cast<std::uint64_t>(threads))
      .texts({o.manifest, o.output, o.command, o.shard, o.outputs})
      .texts(o.words)
      .number(o.no_times ? 1 : 0)
      .text({job.manifest_text.data(), job.manifest_text.size()})
      .take();
}

struct Part {
  cli::BatchJob job;
  int threads = 0;
};

Part part_of(const std::string& bytes) {
  Unpacker packed(bytes);
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
  return part;
}

// Makes rows, on any thread; files that are not kept go to `scratch`.
DoTask row_maker(const cli::BatchJob& job, const TemporaryFolder& scratch) {
  return [&job, &scratch](std::uint64_t row, int threads) {
    const CancelScope scope(cli::keep_going);
    const std::optional<BatchRow> cells = cli::run_row(job, row, threads, scratch.path());
    if (!cells) throw Error(ErrorCode::kCancelled, "interrupted");
    return row_bytes(*cells);
  };
}

// How to go on, for as long as there is a journal.
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
  const cli::RowsToDo to_do = rows_to_do(job, journal);
  const TaskList tasks = {.wide = {to_do.large.begin(), to_do.large.end()},
                          .narrow = {to_do.small.begin(), to_do.small.end()}};
  const int threads = session.context().threads;
  call(ranks, kBatchService, bytes_of(job, threads));
  const TemporaryFolder scratch = cli::scratch_folder();
  lead_tasks(ranks, tasks, threads_here(ranks, threads), row_maker(job, scratch),
             [&](std::uint64_t row, const std::string& bytes) {
               const std::optional<BatchRow> cells = parse_row(bytes);
               if (!cells) throw Error(ErrorCode::kIo, "a row came damaged from another rank");
               journal.append(row, *cells);
               progress->set_done(journal.done());
             });
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
  serve_tasks(ranks, threads_here(ranks, part.threads), row_maker(part.job, scratch));
}

}  // namespace rholm::mpi
