// The winding number of the caps of all tiles. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "reconstruct/caps/tile_caps.h"
#include "rholm/context.h"
#include "shape/queries/winding_tree.h"

namespace rholm {

// One tree for each tile, of which only the first levels stay in memory. The whole tree of a tile
// near the places is made again. The winding number at a place is the sum over the tiles in their
// order, so it does not depend on which trees are in memory.
class TileWinding {
 public:
  // At most `most_trees` whole trees stay in memory at a time.
  TileWinding(const TileCaps& caps, std::size_t n_tiles, std::size_t most_trees);

  // Returns the same as WindingTree::winding() for the caps of all tiles.
  std::vector<double> winding(std::span<const Vec3> x, const Context& context,
                              double opening = kWindingOpening) const;
  WindingNumbers numbers(const Context& context) const;

 private:
  std::shared_ptr<const WindingTree> tree(std::size_t tile) const;

  const TileCaps& caps_;
  std::vector<std::unique_ptr<WindingTree>> tops_;  // none of tiles without caps
  std::size_t most_trees_;
  mutable std::mutex mutex_;
  mutable std::list<std::pair<std::size_t, std::shared_ptr<const WindingTree>>>
      near_;  // last first
};

}  // namespace rholm
