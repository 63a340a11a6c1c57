// The one user of oneTBB.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>

#include "base/chunks.h"

namespace rholm {
namespace {

// One for each number of threads, for good: oneTBB (2021.8) keeps an arena that is done with in its
// lists while any of its threads looks for work, 7 kB each, and walks them for each new one.
tbb::task_arena& arena_of(int threads) {
  static std::mutex mutex;
  static auto& arenas = *new std::map<int, tbb::task_arena>;
  const std::lock_guard lock(mutex);
  return arenas.try_emplace(threads, threads).first->second;
}

}  // namespace

int default_threads() { return std::max(1, tbb::info::default_concurrency()); }

void run_chunks(std::size_t chunks, int threads, const std::function<void(std::size_t)>& run,
                CallSite) {
  // More threads than processors only if asked for; oneTBB prints a warning without this.
  std::optional<tbb::global_control> more;
  if (threads > tbb::info::default_concurrency()) {
    more.emplace(tbb::global_control::max_allowed_parallelism, threads);
  }
  arena_of(threads).execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, chunks, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t c = range.begin(); c != range.end(); ++c) run(c);
        },
        tbb::simple_partitioner());
  });
}

}  // namespace rholm
