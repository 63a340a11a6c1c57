// The one user of oneTBB.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>

#include "base/at_work.h"
#include "base/chunks.h"

namespace rholm {
namespace {

// Callers that do not wait for each other; more do. Chosen: a slot has a few hundred bytes.
constexpr int kCallers = 64;

// One for each number of threads, for good: oneTBB (2021.8) keeps an arena that is done with in its
// lists while any of its threads looks for work, 7 kB each, and walks them for each new one.
// Callers have slots of their own beside those of threads - 1 others: one that found none would
// wait in oneTBB for another to run its loop.
tbb::task_arena& arena_of(int threads) {
  static std::mutex mutex;
  static auto& arenas = *new std::map<int, tbb::task_arena>;
  const std::lock_guard lock(mutex);
  return arenas.try_emplace(threads, threads - 1 + kCallers, kCallers).first->second;
}

}  // namespace

// Not in arena_of(): loops are cut for as many threads as an arena has places for.
void run_limited(int threads, const std::function<void()>& run) {
  if (threads >= tbb::info::default_concurrency()) return run();
  tbb::task_arena(threads).execute(run);
}

int default_threads() { return std::max(1, tbb::info::default_concurrency()); }

void run_chunks(std::size_t chunks, int threads, const std::function<bool(std::size_t)>& run,
                const std::function<void()>& wait, CallSite) {
  // More threads than processors only if asked for; oneTBB prints a warning without this.
  std::optional<tbb::global_control> more;
  if (threads > tbb::info::default_concurrency()) {
    more.emplace(tbb::global_control::max_allowed_parallelism, threads);
  }
  std::atomic<std::size_t> next = 0;
  const auto run_next_ones = [&] {
    for (std::size_t chunk; (chunk = next.fetch_add(1)) < chunks;) {
      if (!run(chunk)) next = chunks;
    }
  };
  arena_of(threads).execute([&] {
    AtWork others;
    tbb::task_group group;
    const std::size_t n_others = std::min<std::size_t>(threads - 1, chunks - 1);
    for (std::size_t i = 0; i < n_others; ++i) {
      group.run([&] {
        others.begin();
        run_next_ones();
        others.end();
      });
    }
    run_next_ones();
    others.wait(wait);
    group.wait();  // those that have not begun find no chunk
  });
}

}  // namespace rholm
