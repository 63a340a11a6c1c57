#include "chart/cap/cap_frame.h"

#include <cmath>

namespace rholm {

double dilation_between(double angle, double opened) {
  return std::tan(opened / 2) / std::tan(angle / 2);
}

double conformal_factor(double a, double cosine) {
  return 2 * a / (1 + cosine + a * a * (1 - cosine));
}

Vec3 dilated(double a, const Vec3& u) {
  if (a == 1) return u;
  const double factor = conformal_factor(a, u.z);
  const double up = 1 + u.z, down = a * a * (1 - u.z);
  return {factor * u.x, factor * u.y, (up - down) / (up + down)};
}

namespace {

// Returns a unit vector orthogonal to z: the coordinate axis farthest from z, made orthogonal.
Vec3 across(const Vec3& z) {
  const double ax = std::abs(z.x), ay = std::abs(z.y), az = std::abs(z.z);
  const Vec3 axis = ax <= ay && ax <= az ? Vec3{1, 0, 0} : ay <= az ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  return normalized(axis - dot(axis, z) * z);
}

}  // namespace

CapFrame cap_frame(const Vec3& seed, const Vec3& axis, double support, double half_angle,
                   double opened) {
  CapFrame frame;
  frame.z = normalized(axis);
  frame.x = across(frame.z);
  frame.y = cross(frame.z, frame.x);
  frame.radius = support / std::tan(half_angle);
  frame.center = seed - frame.radius * frame.z;
  frame.dilation = dilation_between(half_angle, opened);
  frame.support = support;
  return frame;
}

Vec3 in_frame(const CapFrame& frame, const Vec3& x) {
  const Vec3 ray = (x - frame.center) / frame.radius;
  return {dot(ray, frame.x), dot(ray, frame.y), dot(ray, frame.z)};
}

}  // namespace rholm
