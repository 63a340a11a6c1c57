#include "cli/batch/workers.h"

#include <chrono>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "cli/batch/outputs_folder.h"
#include "cli/batch/row.h"
#include "cli/terminal/interrupt.h"
#include "model/batch/row_bytes.h"
#include "parts/threads.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

// Size of a file from which its shape uses all threads (chosen). Smaller ones use one thread each:
// two at once take half the time of one after the other. Two threads on one file gain less than a
// tenth up to 31 MiB, a fifth at 125 MiB (bench/peers/batch.py --sizes). Larger files on one thread
// each would all be in memory at once, and all threads would wait for the last one.
constexpr std::uintmax_t kLargeFile = std::uintmax_t{32} << 20;

std::string text_of_time(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  return seconds < 6000 ? fmt::format("{:.0f} min", seconds / 60)
                        : fmt::format("{:.1f} h", seconds / 3600);
}

// Progress of a batch, and its expected end.
class RowProgress {
 public:
  RowProgress(std::size_t all, const RowsToDo& to_do, Session& session)
      : all_(all), done_(all - to_do.rows.size()), failed_(to_do.failed), session_(session) {}

  void add(bool has_failed) {
    ++done_, ++added_;
    failed_ += has_failed ? 1 : 0;
    show();
  }
  void show() const {
    const std::chrono::duration<double> past = std::chrono::steady_clock::now() - begin_;
    std::string left;
    if (added_ > 0) {
      const double each = past.count() / static_cast<double>(added_);
      left = fmt::format(", {} left", text_of_time(each * static_cast<double>(all_ - done_)));
    }
    session_.context().progress(
        fmt::format("{} of {}, {} failed{}", done_, all_, failed_, left),
        all_ == 0 ? 1 : static_cast<double>(done_) / static_cast<double>(all_));
  }

 private:
  std::size_t all_, done_, failed_, added_ = 0;
  Session& session_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

RowsToDo rows_to_do(const BatchJob& job, const BatchJournal& journal) {
  RowsToDo to_do;
  std::vector<std::size_t> small;
  for (const std::size_t row : job.rows) {
    if (journal.has(row)) {
      to_do.failed += has_failed(journal.read(row)) ? 1 : 0;
      continue;
    }
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path_of(job, row), error);
    (!error && size >= kLargeFile ? to_do.rows : small).push_back(row);
  }
  to_do.n_large = to_do.rows.size();
  to_do.rows.insert(to_do.rows.end(), small.begin(), small.end());
  return to_do;
}

Executor::Work row_work(const BatchJob& job, const std::vector<std::size_t>& rows,
                        const TemporaryFolder& scratch) {
  return [&](std::size_t part, int threads) {
    const CancelScope scope(keep_going);
    const std::optional<BatchRow> cells = run_row(job, rows.at(part), threads, scratch.path());
    if (!cells) throw Error(ErrorCode::kCancelled, "interrupted");
    return row_bytes(*cells);
  };
}

void work_rows(const BatchJob& job, const RowsToDo& to_do, BatchJournal& journal,
               Executor& executor, Session& session, const std::function<void()>& added) {
  std::string input;
  for (const std::size_t row : to_do.rows) put_u64(input, row);
  const TemporaryFolder scratch = scratch_folder();
  RowProgress progress(job.rows.size(), to_do, session);
  // Signals and the progress bar do not wait for the end of a row.
  const CancelScope scope([&] {
    progress.show();
    return keep_going();
  });
  executor.run({.count = to_do.rows.size(),
                .wide = to_do.n_large,
                .in_order = false,
                .input = std::move(input)},
               row_work(job, to_do.rows, scratch), [&](std::size_t part, const std::string& bytes) {
                 const std::optional<BatchRow> cells = parse_row(bytes);
                 if (!cells) throw Error(ErrorCode::kIo, "a row from another process is damaged");
                 journal.append(to_do.rows[part], *cells);
                 progress.add(has_failed(*cells));
                 added();
               });
}

bool run_rows(const BatchJob& job, BatchJournal& journal, Session& session) {
  Threads threads(session.context().threads);
  try {
    work_rows(job, rows_to_do(job, journal), journal, threads, session, [] {});
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kCancelled) throw;
  }
  return interrupting_signal() == 0;
}

}  // namespace rholm::cli
