#include "reconstruct/field/tile_winding.h"

#include <algorithm>
#include <utility>

namespace rholm {
namespace {

WindingTree tree_of(const std::vector<CapPatch>& patches) {
  std::vector<Vec3> points, area_normals;
  points.reserve(patches.size()), area_normals.reserve(patches.size());
  for (const CapPatch& patch : patches) {
    points.push_back(patch.point);
    area_normals.push_back(patch.area * patch.normal);
  }
  return {points, area_normals};
}

// Number of levels of each tile's tree that stay in memory. Chosen: about 20 kB per tile of a
// surface; places farther away than a quarter of its radius do not need the whole tree.
constexpr int kLevels = 3;

}  // namespace

TileWinding::TileWinding(const TileCaps& caps, std::size_t n_tiles, std::size_t most_trees)
    : caps_(caps), tops_(n_tiles), most_trees_(most_trees) {
  for (std::size_t tile = 0; tile < n_tiles; ++tile) {
    const std::vector<CapPatch> patches = caps.patches(tile);
    if (patches.empty()) continue;
    tops_[tile] = std::make_unique<WindingTree>(tree_of(patches).top(kLevels));
  }
}

std::shared_ptr<const WindingTree> TileWinding::tree(std::size_t tile) const {
  const std::scoped_lock lock(mutex_);
  const auto found =
      std::find_if(near_.begin(), near_.end(), [&](const auto& one) { return one.first == tile; });
  if (found != near_.end()) {
    near_.splice(near_.begin(), near_, found);
  } else {
    near_.emplace_front(tile, std::make_shared<const WindingTree>(tree_of(caps_.patches(tile))));
    if (near_.size() > most_trees_) near_.pop_back();
  }
  return near_.front().second;
}

std::vector<double> TileWinding::winding(std::span<const Vec3> x, const Context& context,
                                         double opening) const {
  std::vector<double> sums(x.size(), 0.0);
  std::vector<Vec3> places[2];  // far from a tile's points, near them
  std::vector<std::size_t> indices[2];
  for (std::size_t tile = 0; tile < tops_.size(); ++tile) {
    if (tops_[tile] == nullptr) continue;
    for (std::size_t near = 0; near < 2; ++near) places[near].clear(), indices[near].clear();
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::size_t near = tops_[tile]->has_all(x[i], opening) ? 0 : 1;
      places[near].push_back(x[i]);
      indices[near].push_back(i);
    }
    for (std::size_t near = 0; near < 2; ++near) {
      if (places[near].empty()) continue;
      const std::vector<double> own = near == 1
                                          ? tree(tile)->winding(places[near], context, opening)
                                          : tops_[tile]->winding(places[near], context, opening);
      for (std::size_t k = 0; k < own.size(); ++k) sums[indices[near][k]] += own[k];
    }
  }
  return sums;
}

WindingNumbers TileWinding::numbers(const Context& context) const {
  return [this, context](std::span<const Vec3> x, double opening) {
    return winding(x, context, opening);
  };
}

}  // namespace rholm
