// Support of a cap: the ellipse of its points, CapSupport (method 7.4, 7.5). Layer: atlas.
#pragma once

#include "atlas/cap/cap_fit.h"
#include "rholm/atlas.h"

namespace rholm {

// Returns s^2 of CapSupport for an offset from the seed: 0
// in the middle of the ellipse, below 1 within the support.
inline double place(const Cap& cap, const Vec3& offset) {
  const CapFrame& f = cap.frame;
  const double p = dot(offset, f.x) - cap.where.px, q = dot(offset, f.y) - cap.where.py;
  const double h = dot(offset, f.z) / f.support;
  return cap.where.xx * p * p + 2 * cap.where.xy * p * q + cap.where.yy * q * q + h * h;
}

// Returns the gradient of place() in space.
Vec3 support_gradient(const Cap& cap, const Vec3& offset);

// Returns the longer half axis of the ellipse, in the unit of the cap.
double longer_half_axis(const CapSupport& where);
// Returns the ellipse's middle in the coordinates of the shape.
Vec3 support_middle(const Cap& cap);

// Sets the support to a disc of this radius around the seed.
void set_support(Cap& cap, double support);

// Mean and covariance of points in a frame's plane.
struct PlaneMoments {
  double p = 0, q = 0;
  double xx = 0, xy = 0, yy = 0;
  double middle = 0, radius = 0;  // eigenvalues of the covariance: middle +- radius
};
// Requires at least one point.
PlaneMoments moments_of(const CapFrame& frame, const CapPoints& points);

// Returns the ellipse with this mean and covariance; a full disc of the frame's support
// gives its circle. The half axes are within sqrt(kThinnest) ... 1 of the support.
CapSupport ellipse_of(const CapFrame& frame, const PlaneMoments& moments);
inline constexpr double kThinnest = 0.1;

// Returns true if the covariance is wider across than the thinnest ellipse.
bool fills_ellipse(const CapFrame& frame, const PlaneMoments& moments);

}  // namespace rholm
