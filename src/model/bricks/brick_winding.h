// The winding number of the caps of all bricks. Layer: model, private.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "model/bricks/brick_caps.h"
#include "rholm/context.h"
#include "shape/queries/winding_tree.h"

namespace rholm {

// A tree for each brick, of which only the first levels stay in memory: those that are near what is
// asked for are made again. The number at a place is the sum over the bricks in their order, and
// does not depend on which trees are there.
class BrickWinding {
 public:
  // At most so many trees at a time, but all that one call needs.
  BrickWinding(const BrickCaps& caps, std::size_t n_bricks, std::size_t most_trees);

  // As WindingTree::winding().
  std::vector<double> winding(std::span<const Vec3> x, const Context& context,
                              double opening = kWindingOpening) const;
  WindingNumbers numbers(const Context& context) const;

 private:
  std::shared_ptr<const WindingTree> tree(std::size_t brick) const;

  const BrickCaps& caps_;
  std::vector<std::unique_ptr<WindingTree>> tops_;  // none of bricks without caps
  std::size_t most_trees_;
  mutable std::mutex mutex_;
  mutable std::list<std::pair<std::size_t, std::shared_ptr<const WindingTree>>>
      near_;  // last first
};

}  // namespace rholm
