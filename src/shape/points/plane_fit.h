// Planes and paraboloids fitted to a few points. Layer: shape.
#pragma once

#include <cstddef>
#include <span>

#include "rholm/vec3.h"

namespace rholm {

struct PlaneFit {
  Vec3 normal;  // unit, of either sign; zero if the points have no plane
  // Of the covariance: about the sum of its two smaller eigenvalues, and its largest one. How wide
  // and how long the points are, squared.
  double width = 0;
  double length = 0;
  double height = 0;  // the least eigenvalue: how thick
};

// The plane of least weighted squared distances, through the weighted mean. Coordinates of order 1;
// the sum of the weights is positive.
PlaneFit fit_plane(std::span<const Vec3> points, std::span<const double> weights);

struct ParaboloidFit {
  Vec3 normal;          // at the origin
  double residual = 0;  // rms of the heights over it, weighted
};

// The paraboloid over the plane across `normal` that fits best; the plane through the origin if the
// points do not determine one.
ParaboloidFit fit_paraboloid(std::span<const Vec3> points, std::span<const double> weights,
                             const Vec3& normal);

// A unit vector perpendicular to the unit vector n.
Vec3 perpendicular(const Vec3& n);

}  // namespace rholm
