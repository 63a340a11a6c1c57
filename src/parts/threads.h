// Threads of this process as an executor. Layer: parts, private.
#pragma once

#include <functional>

#include "parts/executor.h"

namespace rholm {

// Computes parts on threads of this process. 0 threads: the number that suits this process.
class Threads final : public Executor {
 public:
  explicit Threads(int threads = 0);

  void run(const Parts& parts, const Work& work, const Take& take) override;
  void once(const std::function<void()>& body) override { body(); }
  bool is_shared() const override { return false; }

 private:
  int threads_;
};

}  // namespace rholm
