// Derivatives next to a pole, where longitudes lose precision, from values around a direction.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "rholm/vec3.h"

namespace rholm {

// Central differences of order 8 along great circles. The relative error of the derivative of a
// harmonic of degree L is (L step)^8 / 630 of L times its size.
inline constexpr std::array<double, 4> kFirstDifference = {4.0 / 5, -1.0 / 5, 4.0 / 105,
                                                           -1.0 / 280};
inline constexpr std::array<double, 4> kSecondDifference = {8.0 / 5, -1.0 / 5, 8.0 / 315,
                                                            -1.0 / 560};
inline constexpr double kSecondMiddle = -205.0 / 72;

// Returns the step in radians. For L = 4 ... 150 (nonuniform_test), the truncation error is below
// 1e-13 in double and 1e-7 in single precision, and rounding errors below 2e-13 and 1e-6.
template <typename T>
double difference_step(int degree) {
  return (sizeof(T) == 4 ? 0.2 : 0.06) / std::max(degree, 1);
}

// Returns the sine of the colatitude below which values around a direction give its derivatives.
// Chosen: 16 values for a gradient and 34 for a Hessian add 1 to 3 ns to the mean source.
inline double polar_sine(int degree, int derivatives) {
  const double least = static_cast<double>(derivatives) / std::max(degree, 1);
  return derivatives > 1 ? std::max(least, 0.05) : least;
}

// Returns two orthonormal directions at right angles to u.
inline std::array<Vec3, 2> tangents(const Vec3& u) {
  const Vec3 a = normalized(cross(std::abs(u.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, u));
  return {a, cross(u, a)};
}

inline Vec3 along(const Vec3& u, const Vec3& tangent, double angle) {
  return std::cos(angle) * u + std::sin(angle) * tangent;
}

struct PolarNode {
  Vec3 u;
  double weight;
};

// Appends nodes with weights whose weighted sum of values is g . grad f at u.
inline void add_gradient_nodes(const Vec3& u, const Vec3& g, double step,
                               std::vector<PolarNode>& nodes) {
  for (const Vec3& t : tangents(u)) {
    const double slope = dot(g, t) / step;
    for (int k = 0; k < 4; ++k) {
      const double weight = slope * kFirstDifference[k];
      nodes.push_back({along(u, t, (k + 1) * step), weight});
      nodes.push_back({along(u, t, -(k + 1) * step), -weight});
    }
  }
}

// Appends nodes for h : Hess f(x/|x|) at |x| = 1, h = xx, xy, xz, yy, yz, zz: second derivatives
// along the principal directions of the tangential part of h, and -2 (h u) . grad f.
inline void add_hessian_nodes(const Vec3& u, const std::array<double, 6>& h, double step,
                              std::vector<PolarNode>& nodes) {
  const auto times = [&](const Vec3& v) {
    return Vec3{h[0] * v.x + h[1] * v.y + h[2] * v.z, h[1] * v.x + h[3] * v.y + h[4] * v.z,
                h[2] * v.x + h[4] * v.y + h[5] * v.z};
  };
  add_gradient_nodes(u, -2.0 * times(u), step, nodes);
  const auto [a, b] = tangents(u);
  const double aa = dot(a, times(a)), ab = dot(a, times(b)), bb = dot(b, times(b));
  const double turn = 0.5 * std::atan2(2 * ab, aa - bb);
  const Vec3 p = std::cos(turn) * a + std::sin(turn) * b;
  const Vec3 q = cross(u, p);
  for (const Vec3& t : {p, q}) {
    const double curvature = dot(t, times(t)) / (step * step);
    nodes.push_back({u, curvature * kSecondMiddle});
    for (int k = 0; k < 4; ++k) {
      const double weight = curvature * kSecondDifference[k];
      nodes.push_back({along(u, t, (k + 1) * step), weight});
      nodes.push_back({along(u, t, -(k + 1) * step), weight});
    }
  }
}

}  // namespace rholm
