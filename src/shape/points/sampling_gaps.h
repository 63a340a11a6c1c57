// How unevenly points cover their surface: lines of a scanner, slices, rings. Layer: shape.
//
// Where points lie in rows, the nearest neighbours of a point are those of its own row, and say
// nothing about the surface across. So neighbourhoods are as large as the gap between rows: a disc
// that reaches as many rows as it would reach points of an even sampling has `ratio` times as many
// points, ratio the gap across over that along.
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

// The circle around a point that holds its 8 nearest has 8 squares of the spacing.
inline constexpr std::size_t kCircle = 8;
inline double spacing_of_circle(double distance2_of_last) {
  return std::sqrt(std::numbers::pi * distance2_of_last / kCircle);
}

struct SamplingGaps {
  // Per point, in the order of the tree, 1 ... kMostGapRatio; empty where no part of the points
  // lies in rows.
  std::vector<float> ratio;

  double of(std::size_t i) const { return ratio.empty() ? 1.0 : static_cast<double>(ratio[i]); }
  // So many neighbours of point i are as many of an even sampling.
  std::size_t scaled(std::size_t i, std::size_t k) const {
    return static_cast<std::size_t>(of(i) * static_cast<double>(k) + 0.5);
  }
  // Of so many neighbours, by distance, one each is a sample as of even points.
  std::size_t stride(std::size_t i) const { return scaled(i, 1); }
  // The median of that.
  std::size_t typical_stride() const;
};

inline constexpr double kMostGapRatio = 30;

// Around a place: between its nearest points, or between their rows.
double spacing_around(const PointTree& tree, const SamplingGaps& gaps, const Vec3& place,
                      std::vector<Neighbor>& near);

// Cosine of two normals below which their points belong to different sheets; noise may turn a few
// that far (method 7.11).
inline constexpr double kOtherSheet = -0.2;

// A gap is the way to a neighbour in the sense of Gabriel (1969): no other point lies in the ball
// between the two. Their covariance, averaged over the points around, has one direction
// along the rows and one across. `normals`, one per point or none, tell sheets apart: where another
// one is as near as the next row, the way to it is no gap of this one.
//
// Rows that turn from one point to the next, as rings around a pole, have no direction in common,
// and their ratio seems to be near 1. With kCount gaps are compared by length too. For fits of
// normals to points known to be on one sheet: with caps so large, and where other sheets are not
// known, edges and thin bodies get worse (scripts/scan-figures).
enum class RowsThatTurn { kIgnore, kCount };
SamplingGaps find_gaps(const PointTree& tree, std::span<const Vec3> points,
                       std::span<const Vec3> normals, const Context& context,
                       RowsThatTurn turning = RowsThatTurn::kIgnore);

// The ratio at some of the points, evenly spread over the order of the tree: for find_gaps(), and
// tests.
std::vector<double> gap_ratios(const PointTree& tree, std::span<const Vec3> points,
                               std::span<const Vec3> normals, std::size_t n_seeds,
                               const Context& context);

}  // namespace rholm
