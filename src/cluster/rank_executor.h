// Executor whose parts are computed by ranks. Layer: cluster, private.
#pragma once

#include <functional>
#include <string>

#include "cluster/ranks.h"
#include "parts/executor.h"

namespace rholm {

// Rank 0 hands out parts to all threads of all ranks, also its own: faster ranks get more parts.
// All ranks call the same functions in the same order, from one thread each. Rank 0 names the parts
// and takes the results. Each function ends on all ranks at once; then all ranks see the pieces
// that any rank has left in a store.
//
// InvalidInput of a part is thrown on rank 0, as if rank 0 had computed the part. Any other
// exception of a part ends the run of all ranks.
class RankExecutor final : public Executor {
 public:
  // `threads` is for each rank; 0 means its share of the processors. `call` runs on rank 0 before
  // each run(), and makes the other ranks call run(); it is empty where they do so anyway.
  RankExecutor(Ranks& ranks, int threads, std::function<void(const Parts& parts)> call = {});

  void run(const Parts& parts, const Work& work, const Take& take) override;
  // Calls the body on rank 0.
  void once(const std::function<void()>& body) override;
  bool is_shared() const override { return true; }

  int threads() const { return threads_; }

 private:
  Ranks& ranks_;
  int threads_;
  std::function<void(const Parts&)> call_;
};

}  // namespace rholm
