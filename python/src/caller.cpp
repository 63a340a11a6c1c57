#include "caller.h"

#include <atomic>
#include <string>

#include <nanobind/stl/string.h>

namespace rholm::python {
namespace {

using namespace std::chrono_literals;

// Interval between checks. Chosen: Ctrl-C may take 0.2 s, mostly time between checks in the
// library.
constexpr auto kLookInterval = 20ms;

std::atomic<bool> threads_were_used = false;
std::atomic<bool> threads_are_gone = false;

}  // namespace

Caller::Watch::Watch(const Caller& caller)
    : caller_(caller), look_due_(std::chrono::steady_clock::now() + kLookInterval) {
  tell_due_ = look_due_;
}

Context Caller::Watch::context() {
  Context context;
  context.threads = threads_are_gone ? 1 : caller_.threads_;
  if (context.threads != 1) threads_were_used = true;
  context.progress = [this](std::string_view stage, double fraction) {
    return look(stage, fraction);
  };
  return context;
}

bool Caller::Watch::look(std::string_view stage, double fraction) {
  // Other threads would find no signals, and callables need not be thread-safe.
  if (stopped_ || std::this_thread::get_id() != thread_) return !stopped_;
  const auto now = std::chrono::steady_clock::now();
  const bool tells = !stage.empty() && !caller_.progress_.is_none() && now >= tell_due_;
  if (!tells && now < look_due_) return true;
  {
    const nb::gil_scoped_acquire acquired;
    try {
      if (PyErr_CheckSignals() != 0) nb::raise_python_error();
      if (tells) {
        const nb::object wish = caller_.progress_(std::string(stage), fraction);
        stopped_ = wish.is(nb::bool_(false));
      }
    } catch (const nb::python_error&) {
      raised_ = std::current_exception();
      stopped_ = true;
    }
  }
  look_due_ = std::chrono::steady_clock::now() + kLookInterval;
  if (tells) tell_due_ = look_due_;
  return !stopped_;
}

void after_fork_in_child() {
  if (threads_were_used) threads_are_gone = true;
}

void bind_caller(nb::module_& m) {
  nb::class_<Caller>(m, "Caller", "Threads and progress of one call.")
      .def(nb::init<int, nb::object>(), nb::arg("threads"), nb::arg("progress").none());
  m.def("after_fork_in_child", &after_fork_in_child,
        "Tells the library that it is in a child of fork(), where there are no threads.");
}

}  // namespace rholm::python
