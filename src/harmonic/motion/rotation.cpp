// Rotations as unit quaternions. Angles come from pairs of components by atan2. Sums of Euler
// angles are then precise even if each angle is undetermined (beta near 0 or pi).
#include <algorithm>
#include <cmath>
#include <string>

#include "base/refuse.h"
#include "rholm/rotate.h"

namespace rholm {
namespace {

// Largest error of orthogonality of a matrix: allows numbers rounded to four digits.
constexpr double kOrthogonality = 1e-4;

Rotation normalized(const Rotation& r) {
  const double length = std::hypot(std::hypot(r.w, r.x), std::hypot(r.y, r.z));
  if (!(length > 0) || !std::isfinite(length)) {
    refuse("a rotation must have a quaternion of finite length above 0");
  }
  return {r.w / length, r.x / length, r.y / length, r.z / length};
}

void check_orthogonal(const RotationMatrix& m) {
  for (int i = 0; i < 3; ++i) {
    if (!is_finite(m[i])) refuse("a rotation matrix has a number that is not finite");
    for (int k = 0; k <= i; ++k) {
      const double product = dot(m[i], m[k]);
      if (!(std::abs(product - (i == k)) <= kOrthogonality)) {
        refuse("row " + std::to_string(i + 1) + " times row " + std::to_string(k + 1) +
               " of the rotation matrix is " + std::to_string(product) + ", not " +
               (i == k ? "1" : "0") + ": give an orthogonal matrix, to at least five digits");
      }
    }
  }
  if (dot(m[0], cross(m[1], m[2])) < 0) {
    refuse("the matrix has determinant -1, a mirror image: mirror an axis, then rotate");
  }
}

}  // namespace

Rotation rotation_about(const Vec3& axis, double angle) {
  const double largest = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
  if (!is_finite(axis) || !(largest > 0)) refuse("the axis of a rotation must not be zero");
  if (!std::isfinite(angle)) refuse("the angle of a rotation must be finite");
  const Vec3 unit = rholm::normalized(axis / largest);
  const double s = std::sin(angle / 2);
  return {std::cos(angle / 2), s * unit.x, s * unit.y, s * unit.z};
}

Rotation rotation_of(const EulerAngles& angles) {
  const EulerAngles& e = angles;
  if (!std::isfinite(e.alpha + e.beta + e.gamma)) refuse("Euler angles must be finite");
  const double sum = (e.alpha + e.gamma) / 2, difference = (e.alpha - e.gamma) / 2;
  const double c = std::cos(e.beta / 2), s = std::sin(e.beta / 2);
  return {c * std::cos(sum), -s * std::sin(difference), s * std::cos(difference),
          c * std::sin(sum)};
}

// Starts from the largest component, which the matrix gives to full precision (Shepperd 1978).
Rotation rotation_of(const RotationMatrix& matrix) {
  const RotationMatrix& m = matrix;
  check_orthogonal(m);
  const double xx = m[0].x, yy = m[1].y, zz = m[2].z;
  const double squares[4] = {1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz,
                             1 - xx - yy + zz};
  int largest = 0;
  for (int i = 1; i < 4; ++i) {
    if (squares[i] > squares[largest]) largest = i;
  }
  const double x = m[2].y - m[1].z, y = m[0].z - m[2].x, z = m[1].x - m[0].y;
  const double xy = m[0].y + m[1].x, yz = m[1].z + m[2].y, zx = m[2].x + m[0].z;
  const double square = squares[largest];
  switch (largest) {
    case 0:
      return normalized({square, x, y, z});
    case 1:
      return normalized({x, square, xy, zx});
    case 2:
      return normalized({y, xy, square, yz});
    default:
      return normalized({z, zx, yz, square});
  }
}

AxisAngle axis_angle_of(const Rotation& rotation) {
  const Rotation r = normalized(rotation);
  const double sign = r.w < 0 ? -1 : 1;
  const Vec3 part = sign * Vec3{r.x, r.y, r.z};
  const double s = norm(part);
  if (!(s > 0)) return {};
  return {part / s, 2 * std::atan2(s, sign * r.w)};
}

EulerAngles euler_angles_of(const Rotation& rotation) {
  const Rotation r = normalized(rotation);
  // At beta = 0 or pi, only their sum or difference exists; atan2(0, 0) = 0 fixes the other.
  const double sum = std::atan2(r.z, r.w), difference = std::atan2(-r.x, r.y);
  return {sum + difference, 2 * std::atan2(std::hypot(r.x, r.y), std::hypot(r.w, r.z)),
          sum - difference};
}

RotationMatrix matrix_of(const Rotation& rotation) {
  const auto [w, x, y, z] = normalized(rotation);
  return {Vec3{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
          Vec3{2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
          Vec3{2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
}

Rotation compose(const Rotation& second, const Rotation& first) {
  const Rotation &a = second, &b = first;
  return normalized({a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
                     a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                     a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                     a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w});
}

Rotation inverse(const Rotation& r) { return {r.w, -r.x, -r.y, -r.z}; }

double angle_between(const Rotation& a, const Rotation& b) {
  return axis_angle_of(compose(a, inverse(b))).angle;
}

Vec3 rotate(const Vec3& x, const Rotation& rotation) {
  const RotationMatrix m = matrix_of(rotation);
  return {dot(m[0], x), dot(m[1], x), dot(m[2], x)};
}

}  // namespace rholm
