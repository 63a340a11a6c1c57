#include "cli/batch/workers.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "cli/batch/outputs_folder.h"
#include "cli/batch/row.h"
#include "cli/terminal/interrupt.h"

namespace rholm::cli {
namespace {

using namespace std::chrono_literals;

// Bytes of a file from which on its shape has all threads (chosen). Small ones go one on each: two
// at once take half the time of one after the other, while two threads on one gain less than a
// tenth up to 31 MiB, a fifth at 125 MiB (bench/peers/batch.py --sizes). Larger ones would be in
// memory as many at a time as there are threads, and the last of them be waited for by all.
constexpr std::uintmax_t kLargeFile = std::uintmax_t{32} << 20;

std::string text_of_time(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  return seconds < 6000 ? fmt::format("{:.0f} min", seconds / 60)
                        : fmt::format("{:.1f} h", seconds / 3600);
}

class Workers {
 public:
  Workers(const BatchJob& job, BatchJournal& journal, Session& session)
      : job_(job),
        journal_(journal),
        session_(session),
        to_do_(rows_to_do(job, journal)),
        done_(job.rows.size() - to_do_.large.size() - to_do_.small.size()),
        first_done_(done_),
        failed_(to_do_.failed) {}

  bool run() {
    const int threads = n_threads();
    for (const std::size_t row : to_do_.large) {
      if (!one(row, threads)) return false;
      show();
    }
    run_small(std::min<std::size_t>(static_cast<std::size_t>(threads), to_do_.small.size()));
    if (failure_) std::rethrow_exception(failure_);
    return interrupting_signal() == 0;
  }

 private:
  int n_threads() const {
    if (session_.context().threads > 0) return session_.context().threads;
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  }

  bool one(std::size_t row, int threads) {
    const CancelScope scope(keep_going);
    const std::optional<BatchRow> cells = run_row(job_, row, threads, scratch_.path());
    if (!cells) return false;
    journal_.append(row, *cells);
    const std::lock_guard lock(mutex_);
    ++done_;
    failed_ += has_failed(*cells) ? 1 : 0;
    return true;
  }

  // Until there are no more rows, or somebody has failed.
  void work() {
    try {
      for (std::size_t i = next_++; i < to_do_.small.size() && !stopped_; i = next_++) {
        if (!one(to_do_.small[i], 1)) stopped_ = true;
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stopped_ = true;
    }
    const std::lock_guard lock(mutex_);
    ++idle_;
    changed_.notify_one();
  }

  // This thread only looks, so that signals and the bar do not wait for a row.
  void run_small(std::size_t n) {
    std::vector<std::jthread> threads;
    threads.reserve(n);
    for (std::size_t i = 0; i < n; ++i) threads.emplace_back([this] { work(); });
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, 100ms, [&] { return idle_ == n; })) {
      lock.unlock();
      show();
      lock.lock();
    }
  }

  void show() {
    std::size_t done = 0, failed = 0;
    {
      const std::lock_guard lock(mutex_);
      done = done_, failed = failed_;
    }
    const std::size_t all = job_.rows.size();
    const std::chrono::duration<double> past = std::chrono::steady_clock::now() - begin_;
    std::string left;
    if (done > first_done_) {
      const double each = past.count() / static_cast<double>(done - first_done_);
      left = fmt::format(", {} left", text_of_time(each * static_cast<double>(all - done)));
    }
    session_.context().progress(
        fmt::format("{} of {}, {} failed{}", done, all, failed, left),
        all == 0 ? 1 : static_cast<double>(done) / static_cast<double>(all));
  }

  const BatchJob& job_;
  BatchJournal& journal_;
  Session& session_;
  const TemporaryFolder scratch_ = scratch_folder();
  const RowsToDo to_do_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::atomic<std::size_t> next_ = 0;  // of the small ones
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::size_t done_, first_done_, failed_, idle_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

RowsToDo rows_to_do(const BatchJob& job, const BatchJournal& journal) {
  RowsToDo to_do;
  for (const std::size_t row : job.rows) {
    if (journal.has(row)) {
      to_do.failed += has_failed(journal.read(row)) ? 1 : 0;
      continue;
    }
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path_of(job, row), error);
    (!error && size >= kLargeFile ? to_do.large : to_do.small).push_back(row);
  }
  return to_do;
}

bool run_rows(const BatchJob& job, BatchJournal& journal, Session& session) {
  return Workers(job, journal, session).run();
}

}  // namespace rholm::cli
