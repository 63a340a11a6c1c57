// Defines which points count as one place when points are merged. Layer: shape, private.
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

// Cells of 2^-23 times the diagonal of a box. Two points that are closer than a cell, but lie in
// different cells, both stay.
class PlaceLattice {
 public:
  PlaceLattice() = default;  // no cells
  // Makes cells for points in the box. There are no cells if the extent is zero, or too large or
  // too small for numbers; then only identical points are at one place.
  explicit PlaceLattice(const Bounds& box);

  bool has_cells() const { return per_length_ > 0; }
  // Returns the cell of a coordinate along an axis: a whole number that never falls as it grows.
  double cell_of(double coordinate, double Vec3::*axis) const {
    return std::floor(per_length_ * (coordinate - origin_.*axis));
  }
  Vec3 cell_of(const Vec3& p) const {
    return {cell_of(p.x, &Vec3::x), cell_of(p.y, &Vec3::y), cell_of(p.z, &Vec3::z)};
  }
  // Returns the smallest coordinate in the cell of a coordinate, or itself if there are no cells.
  double begin_of_cell(double coordinate, double Vec3::*axis) const;

 private:
  Vec3 origin_;
  double per_length_ = 0;
};

// Returns for each point the first point at its place. Points are finite and fewer than 2^32.
std::vector<std::uint32_t> first_in_place(std::span<const Vec3> points, const PlaceLattice& lattice,
                                          const Context& context);

// Gives the first point at each place the mean direction of all normals there, summed
// up in order. Normals at more than 90 degrees to the sum so far are left out.
// Returns the number of these.
std::size_t merge_normals(std::span<const std::uint32_t> first, std::vector<Vec3>& normals);

}  // namespace rholm
