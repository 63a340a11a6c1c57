#include "base/parallel.h"

#include <algorithm>
#include <mutex>
#include <thread>

#include "base/cancel.h"
#include "base/chunks.h"
#include "rholm/error.h"

namespace rholm {

int thread_count(const Context& context) {
  return context.threads > 0 ? context.threads : default_threads();
}

void report_progress(const Context& context, std::string_view stage, double fraction) {
  if (context.progress && !context.progress(stage, fraction)) {
    throw Error(ErrorCode::kCancelled, "the computation was cancelled");
  }
}

void parallel_for(std::size_t n, std::size_t grain, const Context& context,
                  const ParallelStage& stage,
                  const std::function<void(std::size_t, std::size_t)>& body, CallSite where) {
  if (n == 0) return;
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t chunks = (n + grain - 1) / grain;
  std::size_t done = 0;  // guarded by the mutex
  std::mutex mutex;
  const CancelScope* const scope = cancel_scope();
  const std::thread::id caller = std::this_thread::get_id();
  const auto run_chunk = [&](std::size_t chunk) {
    // A thread that waits for a loop of its own may be here to help: what it asks would be about
    // that one.
    const CancelScopeSwap swap(std::this_thread::get_id() == caller ? scope : nullptr);
    body(chunk * grain, std::min(n, (chunk + 1) * grain));
    ask_cancel();
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
  run_chunks(chunks, threads, run_chunk, where);
  ask_cancel();  // this thread may have had no chunk
}

}  // namespace rholm
