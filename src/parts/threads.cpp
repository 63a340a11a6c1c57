#include "parts/threads.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <mutex>
#include <utility>

#include "base/cancel.h"
#include "base/chunks.h"
#include "parts/part_threads.h"

namespace rholm {
namespace {

// Computes one part after the other on this thread.
void run_here(std::size_t first, std::size_t end, int threads, const Executor::Work& work,
              PartResults& results) {
  for (std::size_t part = first; part < end; ++part) {
    ask_cancel();
    results.put(part, work(part, threads));
  }
}

// Computes parts on several threads, while this thread takes their results.
void run_threads(std::size_t first, std::size_t end, std::size_t n, const Executor::Work& work,
                 PartResults& results) {
  std::mutex mutex;  // guards `given`
  std::deque<std::pair<std::size_t, std::string>> given;
  std::atomic<bool> go_on = true;
  const auto work_one = [&](std::size_t part) {
    const CancelScope scope([&] { return go_on.load(std::memory_order_relaxed); });
    std::string bytes = work(part, 1);
    const std::lock_guard lock(mutex);
    given.emplace_back(part, std::move(bytes));
  };
  const auto take_given = [&] {
    std::deque<std::pair<std::size_t, std::string>> taken;
    {
      const std::lock_guard lock(mutex);
      taken.swap(given);
    }
    for (auto& [part, bytes] : taken) results.put(part, std::move(bytes));
  };
  const auto is_any_given = [&] {
    const std::lock_guard lock(mutex);
    return !given.empty();
  };
  PartThreads threads(static_cast<int>(n), work_one, ask_cancel);
  try {
    for (std::size_t next = first; results.taken() < end;) {
      const std::size_t stop = std::min(end, std::max(next, results.end_of_window(n)));
      threads.add(next, stop - next);
      next = stop;
      threads.wait(is_any_given);
      take_given();
    }
  } catch (...) {
    go_on = false;  // a failure is known: parts that are being computed end soon
    throw;
  }
}

}  // namespace

Threads::Threads(int threads) : threads_(threads > 0 ? threads : default_threads()) {}

void Threads::run(const Parts& parts, const Work& work, const Take& take) {
  PartResults results(parts, take);
  const std::size_t wide = std::min(parts.wide, parts.count);
  run_here(0, wide, threads_, work, results);
  const std::size_t n = std::min(static_cast<std::size_t>(threads_), parts.count - wide);
  if (n > 1) {
    run_threads(wide, parts.count, n, work, results);
  } else {
    run_here(wide, parts.count, 1, work, results);
  }
}

}  // namespace rholm
