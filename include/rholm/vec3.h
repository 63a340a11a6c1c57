// A point or vector in space, double precision. Layer: base.
#pragma once

#include <cmath>

namespace rholm {

// Cartesian coordinates.
struct Vec3 {
  double x = 0, y = 0, z = 0;  // in the unit of the shape

  // Returns true for equal numbers: 0 equals -0, NaN does not equal itself.
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

// Coordinate by coordinate, as vectors add and scale.
constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr Vec3 operator*(const Vec3& a, double s) { return s * a; }
constexpr Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }
constexpr Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }
constexpr Vec3& operator-=(Vec3& a, const Vec3& b) { return a = a - b; }
constexpr Vec3& operator*=(Vec3& a, double s) { return a = s * a; }

// Scalar and vector products.
constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// Returns the Euclidean length. It forms squares: keep components within 1e-150 ... 1e150.
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
// Returns a / |a|; a zero vector is returned unchanged.
inline Vec3 normalized(const Vec3& a) {
  const double length = norm(a);
  return length > 0 ? a / length : a;
}
// Returns true if no coordinate is NaN or infinite.
inline bool is_finite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace rholm
