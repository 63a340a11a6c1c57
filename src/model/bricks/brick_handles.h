// Handles smaller than the points can tell, cut in the surface of all bricks. Layer: model,
// private.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_surface.h"
#include "model/points/known_spacings.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// The spacing of a brick's points at each of some places near it.
using SpacingsAt =
    std::function<std::vector<double>(std::size_t brick, const std::vector<Vec3>& places)>;

// See BrickSurface::begin_round().
inline constexpr const char* kCutRound = "cut";

class BrickHandles {
 public:
  BrickHandles(PieceStore& store, BrickSurface& surface, std::size_t n_bricks, double typical,
               SpacingsAt spacings)
      : store_(store),
        surface_(surface),
        n_bricks_(n_bricks),
        typical_(typical),
        spacings_(std::move(spacings)) {}

  // Where the surface turns around and something may be cut, of a brick's mesh as it was extracted:
  // "tight/BRICK". What is near its border is left for all together.
  void find(std::size_t brick, BrickMesh part, const Context& context);
  bool has(std::size_t brick) const;

  // Once all are there: cuts handles as cut_handles() does in the whole surface, and writes the
  // bricks that have changed anew. What is near those places is gathered in memory. Returns how
  // many.
  std::size_t cut(const Context& context);

  // The spacings that both have asked for: "spacings/BRICK", and "spacings/all" of cut().
  std::vector<PlaceAndSpacing> spacings() const;

 private:
  Bounds decided(std::size_t brick) const;

  PieceStore& store_;
  BrickSurface& surface_;
  std::size_t n_bricks_;
  double typical_;
  SpacingsAt spacings_;
};

}  // namespace rholm
