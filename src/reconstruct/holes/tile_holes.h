// Holes in the surface of all tiles, closed a portion at a time: they are where few blocks are.
// Layer: reconstruct, private.
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

// What is open is closed in portions that have little to do with each other; where one has changed
// what another has seen, both are closed again as one, in a further round.
class TileHoles {
 public:
  // After TileSurface::find_values() of all tiles. Portions of at most so many open blocks, but
  // for what is one hole.
  TileHoles(PieceStore& store, TileSurface& surface, const TileWinding& winding,
            std::size_t n_tiles, std::size_t most_open);

  // Of this round.
  std::size_t n_portions() const { return round_.size(); }
  // Fills what is open in a portion, as fill_holes() does with the whole grid:
  // "filling-ROUND/PORTION". Only blocks around it are in memory, at most `max_blocks`; they are
  // made again of the caps near them.
  void close(std::size_t portion, std::size_t max_blocks, const SeenSpace* seen,
             const Context& context);
  bool is_closed(std::size_t portion) const;
  // Once all are: finds which are to be closed again, "again/ROUND", then takes these as the next
  // round. False if there are none.
  void find_conflicts();
  bool take_next_round();
  // After the last round: writes the blocks that have changed to their tiles.
  HoleFilling join();
  // What is left of it in the store.
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
  std::vector<Portion> round_;   // that this round closes
  std::vector<Portion> closed_;  // of the rounds before, but for those that are closed again
  std::vector<std::string> gone_;
};

}  // namespace rholm
