// Surfaces from points, brick by brick. Layer: model, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_crew.h"
#include "model/bricks/point_source.h"
#include "model/bricks/point_survey.h"
#include "rholm/context.h"
#include "rholm/reconstruct.h"

namespace rholm {

struct BrickRunOptions {
  ReconstructOptions reconstruct = {};
  // Blocks with open cubes that are closed together, but for those of one hole. Chosen: of few
  // bricks, whose winding trees are in memory; with the blocks around them 100 MB.
  std::size_t open_blocks = 1024;
  // Called once points are surveyed and cut into so many bricks, before the work.
  std::function<void(const Survey& survey, std::size_t bricks)> foreseen = {};
};

// Reconstructs the source's points in tiles, also if they are few. What is not in memory is in the
// store; a store that has pieces of the same run from before is taken up where that one ended.
// All of the crew call it, with the same arguments but their own source.
Reconstruction run_bricks(PointSource& source, PieceStore& store, const BrickRunOptions& options,
                          BrickCrew& crew, const Context& context);

}  // namespace rholm
