// The sphere a patch of points is projected on. Layer: chart.
//
// Coordinates with moduli of about 1 (see UnitFrame); normals have length 1.
#pragma once

#include <optional>
#include <span>

#include "rholm/vec3.h"

namespace rholm {

struct Sphere {
  Vec3 center;
  double radius = 0;
};

// The sphere of least squares of |p - c|^2 - r^2, (P37), (P38); empty if the points determine none:
// fewer than four, or in a plane.
std::optional<Sphere> fit_sphere(std::span<const Vec3> points);

// Points and their normals, of one patch.
struct PatchPoints {
  std::span<const Vec3> points;
  std::span<const Vec3> normals;
};

// The direction of the mean normal, zero if they cancel.
Vec3 mean_normal(std::span<const Vec3> normals);

// The least n . (p - c) / |p - c|: above 0, every point is seen from its inner side (method 7.2).
// -1 if the centre is one of the points.
double star_cosine(const PatchPoints& patch, const Vec3& center);

struct PatchSphere {
  Sphere sphere;
  Vec3 axis;                  // unit, from the centre to the middle of the patch
  double star_cosine = -1;    // see above
  bool best_fitting = false;  // else the centre lies below the patch
};

// The best-fitting sphere, where its centre sees all of the patch from the inner side, at a cosine
// above `star` >= 0, and is not so far away that it sees it under less than kLeastHalfAngle. Else
// a centre below the patch that sees it under that angle. A patch has at least one point.
inline constexpr double kLeastHalfAngle = 0.2617993877991494;  // 15 degrees, method 7.2
PatchSphere patch_sphere(const PatchPoints& patch, double star);

}  // namespace rholm
