// Ranks as an executor. Layer: cluster, private.
#pragma once

#include <functional>
#include <string>

#include "cluster/ranks.h"
#include "parts/executor.h"

namespace rholm {

// Rank 0 hands parts out to all threads of all ranks, itself as well: ranks that are faster get
// more. All ranks call the same functions in the same order, from one thread each; parts are those
// that rank 0 names, results are taken there. Each function ends on all ranks at once: what one has
// left in a store all see.
//
// InvalidInput of a part is thrown on rank 0, as if it had been worked there. What else one throws
// ends the run of all ranks.
class RankExecutor final : public Executor {
 public:
  // `threads` of each rank; 0: its share of the processors. `call` is called on rank 0 before each
  // run(), and has the others call it, too; none where they do so anyway.
  RankExecutor(Ranks& ranks, int threads, std::function<void(const Parts& parts)> call = {});

  void run(const Parts& parts, const Work& work, const Take& take) override;
  // On rank 0.
  void once(const std::function<void()>& body) override;
  bool is_shared() const override { return true; }

  int threads() const { return threads_; }

 private:
  Ranks& ranks_;
  int threads_;
  std::function<void(const Parts&)> call_;
};

}  // namespace rholm
