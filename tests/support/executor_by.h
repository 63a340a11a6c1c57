// An executor that runs parts through a function, as another process would run them.
#pragma once

#include <functional>
#include <utility>

#include "parts/executor.h"

namespace rholm::test {

class ExecutorBy final : public Executor {
 public:
  using Run = std::function<void(const Parts& parts, const Work& work, const Take& take)>;
  explicit ExecutorBy(Run run) : run_(std::move(run)) {}

  void run(const Parts& parts, const Work& work, const Take& take) override {
    run_(parts, work, take);
  }
  void once(const std::function<void()>& body) override { body(); }
  bool is_shared() const override { return true; }

 private:
  Run run_;
};

}  // namespace rholm::test
