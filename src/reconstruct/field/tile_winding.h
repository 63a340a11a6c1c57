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

// A tree for each tile, of which only the first levels stay in memory: those that are near what is
// asked for are made again. The number at a place is the sum over the tiles in their order, and
// does not depend on which trees are there.
class TileWinding {
 public:
  // At most so many trees at a time, but all that one call needs.
  TileWinding(const TileCaps& caps, std::size_t n_tiles, std::size_t most_trees);

  // As WindingTree::winding().
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
