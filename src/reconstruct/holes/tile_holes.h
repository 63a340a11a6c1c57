// Fills holes in the surface of all tiles, one portion of the open blocks at a time. Layer:
// reconstruct, private.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "parts/store.h"
#include "reconstruct/field/tile_winding.h"
#include "reconstruct/surface/tile_surface.h"
#include "rholm/context.h"
#include "surface/holes/hole_fill.h"
#include "surface/holes/seen_space.h"

namespace rholm {

// Open blocks are closed in portions that rarely influence each other. Where one portion has
// changed a block that another one has read, both are closed again as one, in a further round.
class TileHoles {
 public:
  // After TileSurface::find_values() of all tiles. A portion has at most `most_open` open blocks,
  // unless a single hole has more.
  TileHoles(PieceStore& store, TileSurface& surface, const TileWinding& winding,
            std::size_t n_tiles, std::size_t most_open);

  // Returns the number of portions in this round.
  std::size_t n_portions() const { return round_.size(); }
  // Fills the holes of a portion, as fill_holes() does in the whole grid: "filling-ROUND/PORTION".
  // Only the blocks around it are in memory, at most `max_blocks`. Their values are read, or
  // computed again from the caps near them.
  void close(std::size_t portion, std::size_t max_blocks, const SeenSpace* seen,
             const Context& context);
  bool is_closed(std::size_t portion) const;
  // After close() of all portions: finds the portions to close again, "again/ROUND", then takes
  // them as the next round. Returns false if there are none.
  void find_conflicts();
  bool take_next_round();
  // After the last round: writes the blocks that have changed to their tiles.
  HoleFilling join();
  // Removes the pieces of all portions from the store.
  void forget();

 private:
  struct Portion {
    std::vector<BlockCoordinates> open;
    std::string name;  // of its piece
  };
  void begin_round(std::vector<std::vector<BlockCoordinates>> portions);

  PieceStore& store_;
  TileSurface& surface_;
  const TileWinding& winding_;
  std::size_t n_tiles_;
  std::size_t n_rounds_ = 0;
  std::vector<Portion> round_;   // portions that this round closes
  std::vector<Portion> closed_;  // portions of earlier rounds that stay closed
  std::vector<std::string> gone_;
};

}  // namespace rholm
