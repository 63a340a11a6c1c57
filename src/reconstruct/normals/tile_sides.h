// Signs of the pieces of all tiles relative to each other, and their outer side. Layer:
// reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parts/store.h"
#include "reconstruct/normals/tile_signs.h"
#include "rholm/context.h"

namespace rholm {

// Signs of the pieces of all tiles, in the order of the tiles.
struct JoinedSides {
  std::vector<std::uint64_t> first = {};         // piece of each tile, and the end
  std::vector<std::uint8_t> turned = {};         // per piece
  std::vector<float> trust = {};                 // per piece: trust of its component, see SideTrust
  std::vector<std::uint32_t> component = {};     // per piece
  std::size_t n_components = 0;                  // that have own points
  double doubtful = 0;                           // share of the samples
  bool in_rows = false;                          // points of some tile
  std::vector<SideSample> samples = {};          // of all tiles, with the signs that come of it
  std::vector<std::uint64_t> first_sample = {};  // of each tile, and the end
};

// Joins the pieces in "signs/TILE" by "votes/TILE" of all tiles. First, pieces of two tiles become
// one where most votes of their shared points agree, the most decided ones first. Then votes of
// uncertain edges join pieces, as orient_along_graph() does. The winding number of the samples
// decides all remaining signs, as turn_outwards() does.
JoinedSides join_sides(const PieceStore& store, std::size_t n_tiles, const Context& context);

}  // namespace rholm
