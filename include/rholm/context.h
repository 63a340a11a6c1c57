// Execution of long computations: threads, progress, cancellation. Layer: base.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace rholm {

// Called from time to time, never from two threads at once. The arguments are the name of the
// running stage and the finished part of it, 0 ... 1. Return false to cancel: the computation then
// throws Error{kCancelled} and leaves its outputs untouched.
using ProgressCallback = std::function<bool(std::string_view stage, double fraction)>;

// Results are the same bits for every number of threads.
struct Context {
  int threads = 0;                 // worker threads; 0 means one per processor
  ProgressCallback progress = {};  // none: no progress is reported and nothing is cancelled
};

// Cancels loops of the library on the thread that creates the scope. They call
// `keep_going` every few milliseconds, as a rule, also without a Context and
// between calls of a ProgressCallback. If it returns false they throw
// Error{kCancelled}, as if the callback had. Only the latest of several scopes
// on a thread counts. Worker threads never call it, and it must not throw.
class CancelScope {
 public:
  // Starts the scope; the destructor ends it.
  explicit CancelScope(std::function<bool()> keep_going);
  ~CancelScope();
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

  // Calls the function.
  bool keep_going() const { return keep_going_(); }

 private:
  std::function<bool()> keep_going_;
  const CancelScope* outer_;
};

// Time of a stage, seconds.
struct StageTime {
  double wall = 0;  // wall-clock time
  double cpu = 0;   // processor time, all processors together
};
// Times of stages, by name.
using StageTimes = std::map<std::string, StageTime>;

}  // namespace rholm
