// Asks the CancelScope of the thread whether to stop, in steps that report no progress.
#pragma once

#include <cstddef>

#include "rholm/context.h"

namespace rholm {

// Returns the scope of this thread, or null.
const CancelScope* cancel_scope();

// Throws Error{kCancelled} if this thread's scope says so. Suits steps that take milliseconds.
void ask_cancel();

// Asks once in 8192 calls, for steps of up to a few microseconds. Serves the thread that made it.
//   CancelPoll poll;
//   for (...) { poll(); ... }
class CancelPoll {
 public:
  CancelPoll() : scope_(cancel_scope()) {}
  void operator()() {
    constexpr std::size_t kEvery = std::size_t{1} << 13;  // chosen: asking takes some 50 ns
    if (scope_ != nullptr && (++steps_ & (kEvery - 1)) == 0) ask_cancel();
  }

 private:
  const CancelScope* scope_;
  std::size_t steps_ = 0;
};

// Replaces the scope of this thread, possibly by null, for as long as this object lives.
class CancelScopeSwap {
 public:
  explicit CancelScopeSwap(const CancelScope* scope);
  ~CancelScopeSwap();
  CancelScopeSwap(const CancelScopeSwap&) = delete;
  CancelScopeSwap& operator=(const CancelScopeSwap&) = delete;

 private:
  const CancelScope* before_;
};

}  // namespace rholm
