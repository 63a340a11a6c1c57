// Surfaces from points, tile by tile. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "parts/executor.h"
#include "parts/store.h"
#include "reconstruct/points/point_source.h"
#include "reconstruct/points/point_survey.h"
#include "rholm/context.h"
#include "rholm/reconstruct.h"

namespace rholm {

// Bytes for each point of the only tile, with its part of trees and caps: 347
// (scripts/memory-figures).
inline constexpr std::uint64_t kMemoryOfOnly = 350;

struct TileRunOptions {
  ReconstructOptions reconstruct = {};
  // Blocks with open cubes that are closed together, unless one hole has more. Chosen: of few
  // tiles, whose winding trees are in memory; with the blocks around them 100 MB.
  std::size_t open_blocks = 1024;
  // Called before the work, once points are surveyed and cut into `tiles` tiles.
  std::function<void(const Survey& survey, std::size_t tiles)> foreseen = {};
};

// Reconstructs the source's points in tiles, also if they are few. Data that are not in memory are
// in the store. If the store has pieces of an earlier run, the work goes on where this run ended.
// All processes of the executor call it, with the same arguments but their own source.
Reconstruction run_tiles(PointSource& source, PieceStore& store, const TileRunOptions& options,
                         Executor& executor, const Context& context);

}  // namespace rholm
