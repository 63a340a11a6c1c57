#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
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

namespace {

// Keeps the first of the exceptions that several threads throw.
class FirstException {
 public:
  // Called in a catch block: keeps the current exception, unless there is one already.
  void keep() {
    const std::lock_guard lock(mutex_);
    if (!first_) first_ = std::current_exception();
    any_.store(true, std::memory_order_relaxed);
  }
  bool any() const { return any_.load(std::memory_order_relaxed); }
  // Called when no other thread is left.
  void rethrow() const {
    if (first_) std::rethrow_exception(first_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr first_;
  std::atomic<bool> any_ = false;  // relaxed: it is only a hint to stop
};

}  // namespace

void parallel_for(std::size_t n, std::size_t grain, const Context& context,
                  const ParallelStage& stage,
                  const std::function<void(std::size_t, std::size_t)>& body, CallSite where) {
  if (n == 0) return;
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t chunks = (n + grain - 1) / grain;
  std::size_t done = 0;  // guarded by the mutex
  std::mutex mutex;
  const auto run_chunk = [&](std::size_t chunk) {
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

  FirstException exception;
  const std::thread::id caller = std::this_thread::get_id();
  const CancelScope* const scope = cancel_scope();
  const auto ask_caller = [&] {
    if (exception.any()) return;  // the loop ends already: the caller is not asked again
    try {
      const CancelScopeSwap swap(scope);
      ask_cancel();
    } catch (...) {
      exception.keep();
    }
  };
  const auto run_on_any_thread = [&](std::size_t chunk) {
    // Only the caller asks the user; each thread asks whether another one has failed. The captured
    // `scope` is used because oneTBB may run this chunk on the caller's thread from within another
    // loop. There, cancel_scope() would return the scope of the other loop.
    const bool asks = scope != nullptr && std::this_thread::get_id() == caller;
    const CancelScope of_loop([&] { return !exception.any() && (!asks || scope->keep_going()); });
    try {
      run_chunk(chunk);
    } catch (...) {
      exception.keep();
    }
    return !exception.any();
  };
  run_chunks(chunks, threads, run_on_any_thread, ask_caller, where);
  exception.rethrow();
  ask_cancel();  // this thread may have had no chunk
}

}  // namespace rholm
