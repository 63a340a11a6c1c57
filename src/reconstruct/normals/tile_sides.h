// Signs of the pieces of all tiles to each other, and their outer side. Layer: reconstruct,
// private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parts/store.h"
#include "reconstruct/normals/tile_signs.h"
#include "rholm/context.h"

namespace rholm {

// Of the pieces of all tiles, first those of tile 0.
struct JoinedSides {
  std::vector<std::uint64_t> first = {};         // piece of each tile, and the end
  std::vector<std::uint8_t> turned = {};         // per piece
  std::vector<float> trust = {};                 // per piece: that of its component, see SideTrust
  std::vector<std::uint32_t> component = {};     // per piece
  std::size_t n_components = 0;                  // that have own points
  double doubtful = 0;                           // share of the samples
  bool in_rows = false;                          // points of some tile
  std::vector<SideSample> samples = {};          // of all tiles, with the signs that come of it
  std::vector<std::uint64_t> first_sample = {};  // of each tile, and the end
};

// From the pieces "signs/TILE" and "votes/TILE" of all tiles. Pieces of two tiles become one by
// the votes of the points that they share, the most decided first, where most of them agree; those
// by the votes of edges in doubt, as orient_along_graph() does; and what is still open by the
// winding number of the samples, as turn_outwards() does.
JoinedSides join_sides(const PieceStore& store, std::size_t n_tiles, const Context& context);

}  // namespace rholm
