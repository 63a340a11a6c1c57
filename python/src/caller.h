// How a computation runs for Python: without the interpreter's lock, with progress, stopped by
// Ctrl-C. Layer: python.
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

// Threads and a callable f(stage, fraction), or None. The callable runs on the thread that called;
// it stops the computation by returning False or raising. Signals are looked at there, too, so
// that Ctrl-C raises KeyboardInterrupt.
class Caller {
 public:
  Caller(int threads, nb::object progress) : threads_(threads), progress_(std::move(progress)) {}

  // f(context) without the lock, asked by all that f does on this thread. Throws what f throws, or
  // what the callable or a handler of signals raised instead of the Cancelled that came of it.
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
  // Looks at one computation from the thread that waits for it.
  class Watch {
   public:
    explicit Watch(const Caller& caller);
    Context context();
    std::exception_ptr raised() const { return raised_; }
    // From the thread that waits: looks at signals, and tells the callable of a stage that has a
    // name. False to stop.
    bool look(std::string_view stage, double fraction);

   private:
    const Caller& caller_;
    std::thread::id thread_ = std::this_thread::get_id();
    std::chrono::steady_clock::time_point look_due_, tell_due_;  // not before
    std::atomic<bool> stopped_ = false;
    std::exception_ptr raised_;
  };

  int threads_;
  nb::object progress_;
};

// f() of what takes no Context: without the lock, and stopped by Ctrl-C.
template <class F>
auto unlocked(F&& f) {
  return Caller(1, nb::none()).run([&](const Context&) { return f(); });
}

// A function of the library that takes no Context, called that way.
template <class Result, class... Arguments>
auto unlocked_function(Result (*f)(Arguments...)) {
  return [f](Arguments... arguments) { return unlocked([&] { return f(arguments...); }); };
}

// In a child of fork(): its computations run on one thread if any ran before, as the threads of the
// parent are not there. Results are the same bits.
void after_fork_in_child();

void bind_caller(nb::module_& m);

}  // namespace rholm::python
