// This is the only file that uses oneTBB.
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

// Number of callers that do not wait for each other; further callers do. Chosen: a slot takes a few
// hundred bytes.
constexpr int kCallers = 64;

// Returns the arena for a number of threads, which is kept for good. The reason is that oneTBB
// (2021.8) keeps a finished arena, 7 kB, in its lists while any of its threads looks for work. It
// walks all of them for each new arena. Callers have slots of their own beside the slots of the
// `threads` - 1 other threads. A caller without a slot would wait in oneTBB until another thread
// runs its loop.
tbb::task_arena& arena_of(int threads) {
  static std::mutex mutex;
  static auto& arenas = *new std::map<int, tbb::task_arena>;
  const std::lock_guard lock(mutex);
  return arenas.try_emplace(threads, threads - 1 + kCallers, kCallers).first->second;
}

}  // namespace

// Does not use arena_of(): oneTBB cuts a loop for as many threads as the arena has slots.
void run_limited(int threads, const std::function<void()>& run) {
  if (threads >= tbb::info::default_concurrency()) return run();
  tbb::task_arena(threads).execute(run);
}

int default_threads() { return std::max(1, tbb::info::default_concurrency()); }

void run_chunks(std::size_t chunks, int threads, const std::function<bool(std::size_t)>& run,
                const std::function<void()>& wait, CallSite) {
  // More threads than processors run only on request; without this, oneTBB prints a warning.
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
    group.wait();  // tasks that have not begun find no chunk left
  });
}

}  // namespace rholm
