// Caps as the kernels of cap_field.cpp see them: single precision, in steps of the grid; places
// from its origin.
#pragma once

#include <cstddef>

#include "atlas/cap/cap_limits.h"
#include "atlas/cap/lane_frame.h"
#include "rholm/vec3.h"

namespace rholm {

// That of the caps that reconstruct() makes of points.
inline constexpr int kSmallDegree = 3;

struct CapLane {
  Vec3 seed;
  LaneFrame<float> frame;
  float px, py, xx, xy2, yy, hh;  // CapSupport, hh = 1 / support^2
  double middle;                  // z of the ellipse's
  float extent;                   // of the part of space in its support along z from there
  // Of the form along a row of nodes: half its derivative is row . (p, q, height), half its second
  // row_square. The row crosses the tangent plane at -row_crossing times its height at x = 0.
  float row[3], row_square, row_crossing;
  float reach;         // from the tangent plane: nodes beyond cannot be within the band
  float inverse_band;  // 1 / T
  float trust;         // times the weight: less for a cap that fits its points worse
  int degree;
  bool even;
  bool spline;  // CapBlend::kSpline
  bool noisy;   // its weight falls where it leans
  const float* coefficients;
  bool by_powers;  // to_powers() of kSmallDegree
};

// Slices of a block across z.
struct NodeSlices {
  std::size_t first, end;
};
// Those that may be in a cap's support.
NodeSlices slices_near(const CapLane& cap, const Vec3& first_node);

inline constexpr auto kNoWeight = static_cast<float>(kLeastWeight);
// Sums of weights below it, within so many steps of the surface, are those of caps that end there.
// Measured: three times the weight finds few more and asks for far more winding numbers.
inline constexpr float kDoubtfulWeight = 0.1f;
inline constexpr double kDoubtfulSteps = 1;

}  // namespace rholm
