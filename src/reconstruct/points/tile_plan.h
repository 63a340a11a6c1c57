// Space cut into tiles: a kd-tree of a sample of the points. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reconstruct/points/point_survey.h"
#include "rholm/topology.h"
#include "rholm/vec3.h"
#include "shape/points/place_lattice.h"

namespace rholm {

// Tiles fill all space. Their numbers follow the tree, so tiles with near numbers are mostly near.
class TilePlan {
 public:
  std::size_t n_tiles() const { return cells_.size(); }
  std::size_t tile_of(const Vec3& p) const {
    std::uint32_t at = root_;
    while ((at & kLeaf) == 0) {
      const Cut& cut = cuts_[at];
      at = cut.sides[p.*cut.axis < cut.place ? 0 : 1];
    }
    return at & ~kLeaf;
  }
  // Points of the tile have min <= p < max; infinite where no other tile is beyond.
  const Bounds& cell(std::size_t tile) const { return cells_[tile]; }
  // Returns the tiles whose cells meet the box, ascending.
  std::vector<std::size_t> tiles_meeting(const Bounds& box) const;

 private:
  friend class PlanMaker;
  static constexpr std::uint32_t kLeaf = std::uint32_t{1} << 31;
  struct Cut {
    double place = 0;
    double Vec3::*axis = &Vec3::x;
    std::uint32_t sides[2] = {0, 0};  // below, above: another cut, or a tile and kLeaf
  };
  std::uint32_t root_ = kLeaf;
  std::vector<Cut> cuts_;
  std::vector<Bounds> cells_;
};

// Cuts the box of the sample across its longest side at the median, until no tile has more than
// points_per_tile points by the sample. There is one tile if n_points are not more. Cuts are
// borders of the lattice's cells, so that points at one place are in one tile. The plan depends on
// the set of the sample's points only.
TilePlan make_plan(std::span<const Vec3> sample, const PlaceLattice& lattice, double n_points,
                   double points_per_tile);
// Plans tiles for the different points of a survey: equal points are merged.
TilePlan make_plan(const Survey& survey, std::uint64_t points_per_tile);

}  // namespace rholm
