// Cancellation where no progress is told: by the CancelScope of the thread.
#pragma once

#include <cstddef>

#include "rholm/context.h"

namespace rholm {

// The scope of this thread, or null.
const CancelScope* cancel_scope();

// Throws Error{kCancelled} if this thread's scope says so. For steps that take milliseconds.
void ask_cancel();

// For steps of up to a few microseconds: asks once in many of them. Of the thread that makes it.
//   CancelPoll poll;
//   for (...) { poll(); ... }
class CancelPoll {
 public:
  CancelPoll() : scope_(cancel_scope()) {}
  void operator()() {
    constexpr std::size_t kEvery = std::size_t{1} << 13;  // chosen: a question takes some 50 ns
    if (scope_ != nullptr && (++steps_ & (kEvery - 1)) == 0) ask_cancel();
  }

 private:
  const CancelScope* scope_;
  std::size_t steps_ = 0;
};

// Makes a scope, or none, that of this thread for as long as it lives.
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
