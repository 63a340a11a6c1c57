// Caps as the kernels of cap_field.cpp see them: single precision, in steps of the grid.
#pragma once

#include <cstddef>

#include "atlas/cap/cap_limits.h"
#include "atlas/cap/lane_frame.h"
#include "rholm/vec3.h"

namespace rholm {

struct CapLane {
  Vec3 seed;
  Vec3 middle;  // of the ellipse
  LaneFrame<float> frame;
  float px, py, xx, xy2, yy, hh;  // CapSupport, hh = 1 / support^2
  float box[3];  // half extents of the part of space in its support, about the ellipse's middle
  float reach;   // from the tangent plane: nodes beyond cannot be within the band
  float inverse_band;  // 1 / T
  float trust;         // times the weight: less for a cap that fits its points worse
  int degree;
  bool even;
  bool spline;  // CapBlend::kSpline
  bool noisy;   // its weight falls where it leans
  const float* coefficients;
};

// Rows of a block's nodes; y in pairs, since a vector may hold two rows.
struct NodeRange {
  std::size_t first_y = 0, end_y = 8, first_z = 0, end_z = 8;
};
// Those that may be in a cap's support. `origin` is the block's first node.
NodeRange nodes_near(const CapLane& cap, const Vec3& origin, double step);

// Nodes of a block in their order.
struct NodeTable {
  alignas(64) float x[512];
  alignas(64) float y[512];
  alignas(64) float z[512];
};

inline constexpr auto kNoWeight = static_cast<float>(kLeastWeight);
// Sums of weights below it, within so many steps of the surface, are those of caps that end there.
// Measured: three times the weight finds few more and asks for far more winding numbers.
inline constexpr float kDoubtfulWeight = 0.1f;
inline constexpr double kDoubtfulSteps = 1;

}  // namespace rholm
