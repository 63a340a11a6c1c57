// The surface of bricks cut open where there are no points (method 7.10). Layer: model, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_gather.h"
#include "model/bricks/brick_surface.h"
#include "rholm/context.h"

namespace rholm {

// See BrickSurface::begin_round().
inline constexpr const char* kOpenRound = "open";

// Meshes must have their support: see BrickSurface::extract().
class BrickOpening {
 public:
  BrickOpening(PieceStore& store, BrickSurface& surface, std::size_t n_bricks)
      : store_(store), surface_(surface), n_bricks_(n_bricks) {}

  // The connected parts of a brick's mesh that have no support: "gaps/BRICK".
  void find(std::size_t brick);
  bool has(std::size_t brick) const;
  // Once all are there: cuts away what has none, but for parts of less area than that, as trim()
  // does with the whole. Only what is near the new borders is in memory.
  void cut(double least_area, const Context& context);

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  void join(double least_area);
  std::vector<std::uint32_t> parts(std::size_t brick) const;  // of each vertex, or kNone
  // With what is kept of parts without.
  std::vector<double> gathered_support(const GatheredPart& part) const;
  std::vector<double> support(std::size_t brick, const BrickMesh& mesh) const;

  PieceStore& store_;
  BrickSurface& surface_;
  std::size_t n_bricks_;
  std::vector<std::vector<std::uint8_t>> is_kept_ = {};  // of the parts of each brick
};

}  // namespace rholm
