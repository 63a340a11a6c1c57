// What counts as one place, for points that are merged. Layer: shape, private.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/topology.h"
#include "rholm/vec3.h"

namespace rholm {

// Cells of 2^-23 of the diagonal of a box. Of two points that are closer, but in two cells, both
// stay.
class PlaceLattice {
 public:
  PlaceLattice() = default;  // no cells
  // Of points within the box. A box without an extent has none, nor has one that is too large or
  // too small for numbers: what is identical is at one place then.
  explicit PlaceLattice(const Bounds& box);

  bool has_cells() const { return per_length_ > 0; }
  // Of a coordinate along that axis; whole numbers, that do not fall as it grows.
  double cell_of(double coordinate, double Vec3::*axis) const {
    return std::floor(per_length_ * (coordinate - origin_.*axis));
  }
  Vec3 cell_of(const Vec3& p) const {
    return {cell_of(p.x, &Vec3::x), cell_of(p.y, &Vec3::y), cell_of(p.z, &Vec3::z)};
  }
  // The smallest coordinate in the cell of this one; itself where there are no cells.
  double begin_of_cell(double coordinate, double Vec3::*axis) const;

 private:
  Vec3 origin_;
  double per_length_ = 0;
};

// For each point the first one at its place. Fewer than 2^32 points, finite.
std::vector<std::uint32_t> first_in_place(std::span<const Vec3> points, const PlaceLattice& lattice,
                                          const Context& context);

// Gives each point that is the first at its place the mean direction of the normals of all there,
// in their order, but for those at more than 90 degrees to what is summed up already. Returns how
// many these are.
std::size_t merge_normals(std::span<const std::uint32_t> first, std::vector<Vec3>& normals);

}  // namespace rholm
