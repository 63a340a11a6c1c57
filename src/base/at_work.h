// Waits for the threads of a loop. Layer: base, private.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "base/chunks.h"

namespace rholm {

// Counts the threads that are at work.
class AtWork {
 public:
  explicit AtWork(int n = 0) : n_(n) {}
  void begin() { ++n_; }
  void end() {
    const std::lock_guard lock(mutex_);  // wait() must not miss the notification below
    if (--n_ == 0) none_.notify_one();
  }
  // Waits until no thread is at work; calls `meanwhile` every kWaitInterval.
  void wait(const std::function<void()>& meanwhile) {
    // Most threads have next to nothing left to do, and sleeping and waking take long. Chosen.
    for (int i = 0; i < 200 && n_ > 0; ++i) std::this_thread::yield();
    std::unique_lock lock(mutex_);
    while (!none_.wait_for(lock, kWaitInterval, [&] { return n_ == 0; })) {
      lock.unlock();
      meanwhile();
      lock.lock();
    }
  }

 private:
  std::atomic<int> n_;
  std::mutex mutex_;
  std::condition_variable none_;
};

}  // namespace rholm
