// Fits planes and paraboloids to a few points. Layer: shape.
#pragma once

#include <cstddef>
#include <span>

#include "rholm/vec3.h"

namespace rholm {

struct PlaneFit {
  Vec3 normal;  // unit, of either sign; zero if the points define no plane
  // Squared extents from the covariance: `width` is about the sum of its two smaller eigenvalues,
  // `length` is the largest eigenvalue.
  double width = 0;
  double length = 0;
  double height = 0;  // the least eigenvalue: squared thickness
};

// Returns the plane through the weighted mean with the least weighted sum of squared distances.
// Coordinates are of order 1; the sum of the weights is positive.
PlaneFit fit_plane(std::span<const Vec3> points, std::span<const double> weights);

struct ParaboloidFit {
  Vec3 normal;          // at the origin
  double residual = 0;  // weighted rms height of the points above it
  // The height over the plane through the origin is c + x a + y b + xx a^2 + xy a b + yy b^2, with
  // a along u and b along v.
  Vec3 plane = {}, u = {}, v = {};  // unit vectors; `plane` is its normal
  double c = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  // Return the point of the paraboloid above the place of `offset` in the plane, and its unit
  // normal.
  Vec3 point_at(const Vec3& offset) const;
  Vec3 normal_at(const Vec3& offset) const;
};

// Returns the best paraboloid over the plane across `normal`. If the points do not determine one,
// the result is the plane through the origin.
ParaboloidFit fit_paraboloid(std::span<const Vec3> points, std::span<const double> weights,
                             const Vec3& normal);

// Returns a unit vector perpendicular to the unit vector n.
Vec3 perpendicular(const Vec3& n);

}  // namespace rholm
