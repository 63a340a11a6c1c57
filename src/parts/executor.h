// Divides work into parts and runs them. Layer: parts, private.
//
// The result of a part does not depend on the thread or process that computes the part. So a value
// made from all results, in their order, has the same bits for any number of threads and processes.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace rholm {

struct Parts {
  std::size_t count = 0;
  // Number of first parts that are computed one at a time, each on all threads of a process. Each
  // of the other parts has one thread.
  std::size_t wide = 0;
  // True where results are taken in the order of the parts, and only a few parts are begun ahead.
  // False where results are taken as they come.
  bool in_order = true;
  // True where each process computes consecutive parts, the same parts whenever `count` is the
  // same. False where a free thread of any process gets the next part.
  bool dealt = false;
  // The name of the task and its input, which other processes need to compute the parts.
  std::string job = {}, input = {};
};

class Executor {
 public:
  // Computes a part on `threads` threads and returns the result. Several threads call it at a time.
  // The result is bytes, because another process may have to send it.
  using Work = std::function<std::string(std::size_t part, int threads)>;
  // Takes the result of a part. The thread that calls run() calls it.
  using Take = std::function<void(std::size_t part, std::string bytes)>;

  Executor() = default;
  virtual ~Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  // Computes each part once, and returns when all results are taken. Throws the first exception of
  // `work` or `take` once no part is being computed any more. Throws Cancelled if the CancelScope
  // of this thread says so; it is asked also while others compute.
  virtual void run(const Parts& parts, const Work& work, const Take& take) = 0;
  // Calls the body in the process that takes results, while no part is computed.
  virtual void once(const std::function<void()>& body) = 0;
  // Returns true if other processes compute parts, too.
  virtual bool is_shared() const = 0;
};

}  // namespace rholm
