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
};

// The plane of least weighted squared distances, through the weighted mean. Coordinates of order 1;
// the sum of the weights is positive.
PlaneFit fit_plane(std::span<const Vec3> points, std::span<const double> weights);

// The normal at the origin of the paraboloid over the plane across `normal` that fits best;
// `normal` itself if the points do not determine one.
Vec3 fit_paraboloid(std::span<const Vec3> points, std::span<const double> weights,
                    const Vec3& normal);

// A unit vector perpendicular to the unit vector n.
Vec3 perpendicular(const Vec3& n);

}  // namespace rholm
