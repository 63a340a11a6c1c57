// How a long computation runs: threads, progress, cancellation. Layer: base.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace rholm {

// Called from time to time, never from two threads at once, with the name of the running stage
// and the part of it that is done, 0 ... 1. Return false to cancel: the computation then throws
// Error{kCancelled} and leaves its outputs untouched.
using ProgressCallback = std::function<bool(std::string_view stage, double fraction)>;

// Results are the same bits for every number of threads.
struct Context {
  int threads = 0;                 // worker threads; 0 means one per processor
  ProgressCallback progress = {};  // none: nobody is told, nothing is cancelled
};

// While it lives, loops of the library on the thread that made it ask `keep_going` from time to
// time (every few milliseconds, as a rule), also those of functions that take no Context, and those
// between two calls of a ProgressCallback. Where it returns false, they throw Error{kCancelled}, as
// if the callback had. Of several on one thread the last counts. It is never called by other
// threads that work for this one, and must not throw.
class CancelScope {
 public:
  // From here on, until it ends.
  explicit CancelScope(std::function<bool()> keep_going);
  ~CancelScope();
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

  // Asks.
  bool keep_going() const { return keep_going_(); }

 private:
  std::function<bool()> keep_going_;
  const CancelScope* outer_;
};

// Time of a stage, seconds.
struct StageTime {
  double wall = 0;  // on the clock
  double cpu = 0;   // of all processors together
};
// Times of stages by their names.
using StageTimes = std::map<std::string, StageTime>;

}  // namespace rholm
