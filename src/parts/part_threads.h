// Building blocks of executors: threads that compute parts, and results in their order. Layer:
// parts, private.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/chunks.h"
#include "parts/executor.h"

namespace rholm {

// Threads that compute the parts of a queue. After the first failure no part is begun.
class PartThreads {
 public:
  // While the owner waits, it calls `meanwhile` every few milliseconds; `meanwhile` may throw.
  PartThreads(int threads, std::function<void(std::size_t part)> work,
              std::function<void()> meanwhile);
  // Drops the queue, and waits for parts that are being computed.
  ~PartThreads();
  PartThreads(const PartThreads&) = delete;
  PartThreads& operator=(const PartThreads&) = delete;

  // Adds parts `first` ... `first` + `n` - 1 to the queue.
  void add(std::size_t first, std::size_t n);
  // Waits until no more than `most` parts are in the queue.
  void wait_for_queue(std::size_t most) {
    wait([&] { return queue_.size() <= most; });
  }
  // Waits until all parts are computed.
  void wait_for_all() {
    wait([&] { return queue_.empty() && busy_ == 0; });
  }
  // Waits until the condition, which is asked after each part, holds. Throws the first failure.
  template <typename Condition>
  void wait(const Condition& condition) {
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, kWaitInterval, [&] { return failure_ || condition(); })) {
      lock.unlock();
      meanwhile_();
      lock.lock();
    }
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void work_on();

  const std::function<void(std::size_t)> work_;
  const std::function<void()> meanwhile_;
  std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::deque<std::size_t> queue_;
  int busy_ = 0;
  bool ended_ = false;
  std::exception_ptr failure_;
  std::vector<std::jthread> threads_;
};

// Passes results on to `take`, in the order that Parts asks for.
class PartResults {
 public:
  PartResults(const Parts& parts, const Executor::Take& take) : parts_(parts), take_(take) {}

  // Takes a result and results that waited for it, or keeps it until all earlier ones are there.
  void put(std::size_t part, std::string bytes);
  // Returns the first part that may not begin before more results are taken, for `threads` threads.
  std::size_t end_of_window(std::size_t threads) const {
    return parts_.in_order ? taken_ + 2 * threads : parts_.count;
  }
  std::size_t taken() const { return taken_; }

 private:
  const Parts& parts_;
  const Executor::Take& take_;
  std::size_t taken_ = 0;
  std::map<std::size_t, std::string> waiting_;
};

}  // namespace rholm
