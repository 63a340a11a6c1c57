#include "base/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>

#include "rholm/error.h"

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

int thread_count(const Context& context) {
  return context.threads > 0 ? context.threads : std::max(1, tbb::info::default_concurrency());
}

void report_progress(const Context& context, std::string_view stage, double fraction) {
  if (context.progress && !context.progress(stage, fraction)) {
    throw Error(ErrorCode::kCancelled, "the computation was cancelled");
  }
}

void parallel_for(std::size_t n, std::size_t grain, const Context& context,
                  const ParallelStage& stage,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  if (n == 0) return;
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t chunks = (n + grain - 1) / grain;
  std::size_t done = 0;  // guarded by the mutex
  std::mutex mutex;
  const auto run_chunk = [&](std::size_t chunk) {
    body(chunk * grain, std::min(n, (chunk + 1) * grain));
    if (!context.progress) return;
    const std::lock_guard lock(mutex);
    ++done;
    const double part = static_cast<double>(done) / static_cast<double>(chunks);
    report_progress(context, stage.name, stage.from + part * (stage.to - stage.from));
  };
  const int threads = thread_count(context);
  if (threads == 1 || chunks == 1) {
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) run_chunk(chunk);
    return;
  }
  // More threads than processors only if asked for; oneTBB prints a warning without this.
  std::optional<tbb::global_control> more;
  if (threads > tbb::info::default_concurrency()) {
    more.emplace(tbb::global_control::max_allowed_parallelism, threads);
  }
  arena_of(threads).execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, chunks, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t c = range.begin(); c != range.end(); ++c) run_chunk(c);
        },
        tbb::simple_partitioner());
  });
}

}  // namespace rholm
