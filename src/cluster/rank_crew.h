// Ranks as a crew that works on tiles. Layer: cluster, private.
#pragma once

#include <cstddef>
#include <functional>

#include "cluster/ranks.h"
#include "reconstruct/points/tile_crew.h"

namespace rholm {

// Rank 0 hands tiles out, one at a time, to all threads of a rank. The end of each stage is a
// barrier: what one rank has left in the store all see.
class RankCrew final : public TileCrew {
 public:
  RankCrew(Ranks& ranks, int threads) : ranks_(ranks), threads_(threads) {}

  void each(std::size_t n, const Body& body, const Done& done) override;
  void once(const std::function<void()>& body) override;

 private:
  Ranks& ranks_;
  int threads_;
};

}  // namespace rholm
