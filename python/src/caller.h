// Runs computations for Python: without the interpreter's lock, with progress, stopped by Ctrl-C.
// Layer: python.
#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <string_view>
#include <thread>
#include <utility>

#include "rholm/context.h"
#include "rholm/error.h"

namespace rholm::python {

namespace nb = nanobind;

// Threads and a callable f(stage, fraction), or None. The callable runs on the calling thread. It
// stops the computation by returning False or raising an exception. The calling thread also checks
// signals, so that Ctrl-C raises KeyboardInterrupt.
class Caller {
 public:
  Caller(int threads, nb::object progress) : threads_(threads), progress_(std::move(progress)) {}

  // Runs f(context) without the lock; functions that f calls on this thread can be cancelled.
  // Throws as f; an exception of the callable or a signal handler replaces Cancelled.
  template <class F>
  auto run(F&& f) const {
    Watch watch(*this);
    const CancelScope scope([&watch] { return watch.look({}, 0); });
    try {
      const nb::gil_scoped_release released;
      return f(watch.context());
    } catch (const Error& error) {
      if (error.code() == ErrorCode::kCancelled && watch.raised()) {
        std::rethrow_exception(watch.raised());
      }
      throw;
    }
  }

 private:
  // Watches one computation on the thread that waits for it.
  class Watch {
   public:
    explicit Watch(const Caller& caller);
    Context context();
    std::exception_ptr raised() const { return raised_; }
    // Runs on the waiting thread: checks signals, and calls the callable for a stage with a name.
    // Returns false to stop.
    bool look(std::string_view stage, double fraction);

   private:
    const Caller& caller_;
    std::thread::id thread_ = std::this_thread::get_id();
    std::chrono::steady_clock::time_point look_due_, tell_due_;  // earliest time of the next check
    std::atomic<bool> stopped_ = false;
    std::exception_ptr raised_;
  };

  int threads_;
  nb::object progress_;
};

// Runs f() that takes no Context: without the lock, and stopped by Ctrl-C.
template <class F>
auto unlocked(F&& f) {
  return Caller(1, nb::none()).run([&](const Context&) { return f(); });
}

// Wraps a function of the library without Context by unlocked().
template <class Result, class... Arguments>
auto unlocked_function(Result (*f)(Arguments...)) {
  return [f](Arguments... arguments) { return unlocked([&] { return f(arguments...); }); };
}

// Runs in a child of fork(). Its computations use one thread if the parent had used threads,
// because these do not exist in the child. Results are the same bits.
void after_fork_in_child();

void bind_caller(nb::module_& m);

}  // namespace rholm::python
