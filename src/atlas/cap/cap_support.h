// Where a cap has weight: the ellipse of its points, CapSupport (method 7.4, 7.5). Layer: atlas.
#pragma once

#include "atlas/cap/cap_fit.h"
#include "rholm/atlas.h"

namespace rholm {

// Where a point lies, by its offset from the seed: s^2 of CapSupport, 0 in the middle of the
// ellipse, below 1 within the support.
inline double place(const Cap& cap, const Vec3& offset) {
  const CapFrame& f = cap.frame;
  const double p = dot(offset, f.x) - cap.where.px, q = dot(offset, f.y) - cap.where.py;
  const double h = dot(offset, f.z) / f.support;
  return cap.where.xx * p * p + 2 * cap.where.xy * p * q + cap.where.yy * q * q + h * h;
}

// Its gradient there, in space.
Vec3 support_gradient(const Cap& cap, const Vec3& offset);

// Of the ellipse, in the unit of the cap.
double longer_half_axis(const CapSupport& where);
// Its middle, in the coordinates of the shape.
Vec3 support_middle(const Cap& cap);

// Makes the support a disc of that radius around the seed.
void set_support(Cap& cap, double support);

// Mean and covariance of points in a frame's plane.
struct PlaneMoments {
  double p = 0, q = 0;
  double xx = 0, xy = 0, yy = 0;
  double middle = 0, radius = 0;  // eigenvalues of the covariance: middle +- radius
};
// At least one point.
PlaneMoments moments_of(const CapFrame& frame, const CapPoints& points);

// The ellipse with that mean and covariance: those of a full disc of the frame's support give its
// circle. Its half axes are within sqrt(kThinnest) ... 1 of the support.
CapSupport ellipse_of(const CapFrame& frame, const PlaneMoments& moments);
inline constexpr double kThinnest = 0.1;

// Whether the covariance is wider than the thinnest ellipse's across.
bool fills_ellipse(const CapFrame& frame, const PlaneMoments& moments);

}  // namespace rholm
