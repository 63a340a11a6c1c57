// Waits for the threads of a loop. Layer: base, private.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "base/chunks.h"

namespace rholm {

// Counts threads at work.
class AtWork {
 public:
  explicit AtWork(int n = 0) : n_(n) {}
  void begin() { ++n_; }
  void end() {
    const std::lock_guard lock(mutex_);  // not between a look at the number and the sleep
    if (--n_ == 0) none_.notify_one();
  }
  // Until there are none; calls `meanwhile` from time to time.
  void wait(const std::function<void()>& meanwhile) {
    // Most have next to nothing left to do, and to sleep and be woken takes long. Chosen.
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
