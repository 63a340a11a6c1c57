// Measures how unevenly points cover a surface: lines of a scanner, slices, rings. Layer: shape.
//
// Where points lie in rows, the nearest neighbours of a point belong to its own row and say nothing
// about the surface across. So neighbourhoods must be as wide as the gap between rows. A disc that
// reaches as many rows as it reaches points of an even sampling has `ratio` times as many points.
// `ratio` is the gap across rows over the gap along them.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"

namespace rholm {

// The circle around a point that holds its 8 nearest points has the area of 8 squared spacings.
inline constexpr std::size_t kCircle = 8;
inline double spacing_of_circle(double distance2_of_last) {
  return std::sqrt(std::numbers::pi * distance2_of_last / kCircle);
}

struct SamplingGaps {
  // Ratio per point, in the order of the tree, 1 ... kMostGapRatio. It is empty if no part
  // of the points lies in rows.
  std::vector<float> ratio;

  double of(std::size_t i) const { return ratio.empty() ? 1.0 : static_cast<double>(ratio[i]); }
  // Returns the number of neighbours of point i that corresponds to k in an even sampling.
  std::size_t scaled(std::size_t i, std::size_t k) const {
    return static_cast<std::size_t>(of(i) * static_cast<double>(k) + 0.5);
  }
  // Returns s: every s-th neighbour of point i, by distance, forms a nearly even sample.
  std::size_t stride(std::size_t i) const { return scaled(i, 1); }
  // Returns the median of stride() over all points.
  std::size_t typical_stride() const;
};

inline constexpr double kMostGapRatio = 30;

// Returns the distance between the points nearest to a place, or between their rows.
double spacing_around(const PointTree& tree, const SamplingGaps& gaps, const Vec3& place,
                      std::vector<Neighbor>& near);

// Cosine of two normals, below which their points belong to different sheets. Noise may turn a few
// normals so far (method 7.11).
inline constexpr double kOtherSheet = -0.2;

// Computes the ratio of gaps. A gap is the vector to a neighbour in the sense of Gabriel (1969):
// the ball whose diameter is this vector contains no other point. The covariance of gaps,
// averaged over points around, has one direction along the rows and one across. `normals`, one
// per point or none, distinguish sheets: a vector to another sheet, as near as the next row, is
// no gap.
//
// Rows that turn from point to point, such as rings around a pole, have no common direction, and
// their ratio seems to be near 1. kCount also compares lengths of gaps. It is for normals known
// to be on one sheet. On other inputs, edges and thin bodies get worse (scripts/scan-figures).
enum class RowsThatTurn { kIgnore, kCount };
SamplingGaps find_gaps(const PointTree& tree, std::span<const Vec3> points,
                       std::span<const Vec3> normals, const Context& context,
                       RowsThatTurn turning = RowsThatTurn::kIgnore);

// Returns the ratio at some of the points, evenly spread over the order of the tree. It is used by
// find_gaps() and by tests.
std::vector<double> gap_ratios(const PointTree& tree, std::span<const Vec3> points,
                               std::span<const Vec3> normals, std::size_t n_seeds,
                               const Context& context);

}  // namespace rholm
