// The sphere on which a patch of points is projected. Layer: chart.
//
// Coordinates have moduli of about 1 (see UnitFrame); normals have length 1.
#pragma once

#include <optional>
#include <span>

#include "rholm/vec3.h"

namespace rholm {

struct Sphere {
  Vec3 center;
  double radius = 0;
};

// Returns the sphere of least squares of |p - c|^2 - r^2, (P37), (P38). Empty if the points
// determine none: fewer than four, or in a plane.
std::optional<Sphere> fit_sphere(std::span<const Vec3> points);

// The points of one patch and their normals.
struct PatchPoints {
  std::span<const Vec3> points;
  std::span<const Vec3> normals;
};

// Returns the direction of the mean normal, or zero if the normals cancel.
Vec3 mean_normal(std::span<const Vec3> normals);

// Returns the least n . (p - c) / |p - c|. If it is above 0, the centre sees every point from the
// inner side (method 7.2). It is -1 if the centre is one of the points.
double star_cosine(const PatchPoints& patch, const Vec3& center);

struct PatchSphere {
  Sphere sphere;
  Vec3 axis;                  // unit, from the centre to the middle of the patch
  double star_cosine = -1;    // see above
  bool best_fitting = false;  // else the centre is below the patch
};

// Returns the best-fitting sphere if its centre sees the patch from the inner side, at a cosine
// above `star` >= 0, under at least kLeastHalfAngle. Otherwise the centre is below the patch and
// sees it under this angle. A patch has at least one point.
inline constexpr double kLeastHalfAngle = 0.2617993877991494;  // 15 degrees, method 7.2
PatchSphere patch_sphere(const PatchPoints& patch, double star);

}  // namespace rholm
