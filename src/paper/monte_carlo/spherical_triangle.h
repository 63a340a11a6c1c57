// Points uniform on a spherical triangle.
#pragma once

#include <array>

#include "rholm/vec3.h"

namespace rholm {

// Data of a triangle with positive solid angle for Arvo's map (Stratified Sampling of Spherical
// Triangles, 1995).
struct SphericalTriangle {
  Vec3 a, b;         // directions of two corners
  Vec3 toward;       // unit tangent at a towards the third
  double omega = 0;  // solid angle, > 0
  double one_plus_ab = 0;
  double volume = 0;  // a . (b x toward)
  double lean = 0;    // b . toward
};

// Takes corners counter-clockwise as seen from outside (positive solid angle `omega`).
SphericalTriangle spherical_triangle(const std::array<Vec3, 3>& corners, double omega);

// Maps the unit square to the triangle with a constant ratio of solid angle to area. Accurate for
// triangles of any size.
Vec3 uniform_direction(const SphericalTriangle& triangle, double along, double across);

}  // namespace rholm
