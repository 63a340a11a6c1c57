#include "shape/points/place_lattice.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "base/parallel.h"
#include "shape/topology/identical.h"

namespace rholm {
namespace {

// Points closer than this part of the extent are at one place: distances between neighbours have
// single precision (point_tree.h).
constexpr double kPlace = 0x1p-23;

// Scales before it normalises, because normals in a file have any length.
Vec3 unit_or_zero(const Vec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || !is_finite(v)) return {};
  return normalized({v.x / largest, v.y / largest, v.z / largest});
}

// Maps numbers to integers in the same order.
std::int64_t rank_of(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x + 0.0);
  return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
}
double of_rank(std::int64_t rank) {
  return std::bit_cast<double>(rank < 0 ? std::numeric_limits<std::int64_t>::min() - rank : rank);
}

}  // namespace

PlaceLattice::PlaceLattice(const Bounds& box) : origin_(box.min) {
  const double per_length = 1 / (kPlace * box.diagonal());
  if (std::isnormal(per_length)) per_length_ = per_length;
}

double PlaceLattice::begin_of_cell(double coordinate, double Vec3::*axis) const {
  if (!has_cells()) return coordinate;
  const double cell = cell_of(coordinate, axis);
  if (!(cell > 0)) return origin_.*axis;
  // Bisects: near 0, far from the origin, neighbouring numbers are closer than cells can tell.
  std::int64_t below = rank_of(origin_.*axis), at = rank_of(coordinate);
  for (;;) {
    const std::uint64_t apart = static_cast<std::uint64_t>(at) - static_cast<std::uint64_t>(below);
    if (apart <= 1) break;
    const std::int64_t middle = below + static_cast<std::int64_t>(apart / 2);
    (cell_of(of_rank(middle), axis) < cell ? below : at) = middle;
  }
  return of_rank(at);
}

std::vector<std::uint32_t> first_in_place(std::span<const Vec3> points, const PlaceLattice& lattice,
                                          const Context& context) {
  if (!lattice.has_cells()) return first_identical(points, context);
  std::vector<Vec3> places(points.size());
  parallel_for(points.size(), 8192, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) places[i] = lattice.cell_of(points[i]);
  });
  return first_identical(places, context);
}

std::size_t merge_normals(std::span<const std::uint32_t> first, std::vector<Vec3>& normals) {
  std::vector<Vec3> sums(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) sums[i] = unit_or_zero(normals[i]);
  std::size_t opposite = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (first[i] == i) continue;
    Vec3& sum = sums[first[i]];
    const Vec3 own = unit_or_zero(normals[i]);
    if (dot(own, sum) < 0) {
      ++opposite;
    } else {
      sum += own;
    }
    normals[first[i]] = normalized(sum);
  }
  return opposite;
}

}  // namespace rholm
