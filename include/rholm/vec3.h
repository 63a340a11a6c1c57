// A point or vector in space, double precision. Layer: base.
#pragma once

#include <cmath>

namespace rholm {

// Cartesian coordinates.
struct Vec3 {
  double x = 0, y = 0, z = 0;  // in whatever unit the shape has

  // Equal numbers: 0 and -0 are, NaN is not itself.
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

// As vectors add and scale, coordinate by coordinate.
constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr Vec3 operator*(const Vec3& a, double s) { return s * a; }
constexpr Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }
constexpr Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }
constexpr Vec3& operator-=(Vec3& a, const Vec3& b) { return a = a - b; }
constexpr Vec3& operator*=(Vec3& a, double s) { return a = s * a; }

// Scalar and vector product.
constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// Euclidean length; squares are formed, so components should be within 1e-150 ... 1e150.
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
// a / |a|; a zero vector is returned as it is.
inline Vec3 normalized(const Vec3& a) {
  const double length = norm(a);
  return length > 0 ? a / length : a;
}
// Neither NaN nor infinite in any coordinate.
inline bool is_finite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace rholm
