// Caps in the form that the kernels of cap_field.cpp use: single
// precision, in steps of the grid, with positions relative to its origin.
#pragma once

#include <cstddef>

#include "atlas/cap/cap_limits.h"
#include "atlas/cap/lane_frame.h"
#include "rholm/vec3.h"

namespace rholm {

// Degree of the caps that reconstruct() makes from points.
inline constexpr int kSmallDegree = 3;

struct CapLane {
  Vec3 seed;
  LaneFrame<float> frame;
  float px, py, xx, xy2, yy, hh;  // CapSupport, hh = 1 / support^2
  double middle;                  // z of the ellipse's centre
  float extent;                   // half extent of the support along z, measured from `middle`
  // Half the form's derivative along a row of nodes is row . (p, q, height), half its second
  // row_square. The row meets the tangent plane at x = -row_crossing times its height at x = 0.
  float row[3], row_square, row_crossing;
  float reach;         // largest distance from the tangent plane within the band
  float inverse_band;  // 1 / T
  float trust;         // factor of the weight: smaller for a cap with a larger fit error
  int degree;
  bool even;
  bool spline;  // true for CapBlend::kSpline
  bool noisy;   // weight decreases where the surface leans
  const float* coefficients;
  bool by_powers;  // coefficients are in to_powers() form of kSmallDegree
};

// Range of a block's slices across z.
struct NodeSlices {
  std::size_t first, end;
};
// Returns the slices that may be in a cap's support.
NodeSlices slices_near(const CapLane& cap, const Vec3& first_node);

inline constexpr auto kNoWeight = static_cast<float>(kLeastWeight);
// A node is doubtful if its sum of weights is less and the surface is within kDoubtfulSteps: the
// caps end there. Measured: three times the weight finds hardly more, for far more winding numbers.
inline constexpr float kDoubtfulWeight = 0.1f;
inline constexpr double kDoubtfulSteps = 1;

}  // namespace rholm
