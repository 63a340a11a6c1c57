#include "shape/points/plane_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shape/points/symmetric.h"

namespace rholm {
namespace {

Symmetric3 covariance(std::span<const Vec3> points, std::span<const double> weights) {
  double total = 0;
  Vec3 mean;
  for (std::size_t i = 0; i < points.size(); ++i) {
    total += weights[i];
    mean += weights[i] * points[i];
  }
  mean = mean / total;
  Symmetric3 c;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 d = points[i] - mean;
    const Vec3 wd = weights[i] / total * d;
    c.xx += wd.x * d.x;
    c.xy += wd.x * d.y;
    c.xz += wd.x * d.z;
    c.yy += wd.y * d.y;
    c.yz += wd.y * d.z;
    c.zz += wd.z * d.z;
  }
  return c;
}

// Returns the sum of the products of two eigenvalues each. Unlike eigenvalues, it is exact to an
// ulp of the largest eigenvalue's square.
double sum_of_minors(const Symmetric3& m) {
  return (m.xx * m.yy - m.xy * m.xy) + (m.xx * m.zz - m.xz * m.xz) + (m.yy * m.zz - m.yz * m.yz);
}

// Returns the null direction of M - value: the longest cross product of two of its rows.
Vec3 eigenvector(const Symmetric3& m, double value) {
  const Vec3 rows[3] = {
      {m.xx - value, m.xy, m.xz}, {m.xy, m.yy - value, m.yz}, {m.xz, m.yz, m.zz - value}};
  const Vec3 products[3] = {cross(rows[0], rows[1]), cross(rows[1], rows[2]),
                            cross(rows[2], rows[0])};
  return normalized(*std::max_element(
      products, products + 3, [](const Vec3& a, const Vec3& b) { return dot(a, a) < dot(b, b); }));
}

constexpr int kTerms = kSix;  // terms 1, x, y, x^2, x y, y^2

}  // namespace

PlaneFit fit_plane(std::span<const Vec3> points, std::span<const double> weights) {
  const Symmetric3 m = covariance(points, weights);
  const Eigenvalues values = eigenvalues(m);
  PlaneFit fit{.normal = eigenvector(m, values.least)};
  if (!(values.largest > 0)) return fit;
  fit.length = values.largest;
  fit.height = std::max(values.least, 0.0);
  fit.width = std::max(sum_of_minors(m) / values.largest, 0.0);
  return fit;
}

ParaboloidFit fit_paraboloid(std::span<const Vec3> points, std::span<const double> weights,
                             const Vec3& normal) {
  const Vec3 u = perpendicular(normal), v = cross(normal, u);
  Matrix6 a{};
  Vector6 b{};
  double squares = 0, total = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = dot(points[i], u), y = dot(points[i], v), z = dot(points[i], normal);
    const double terms[kTerms] = {1, x, y, x * x, x * y, y * y};
    for (int j = 0; j < kTerms; ++j) {
      const double wj = weights[i] * terms[j];
      for (int k = 0; k <= j; ++k) a[j][k] += wj * terms[k];
      b[j] += wj * z;
    }
    squares += weights[i] * z * z;
    total += weights[i];
  }
  Vector6 c = b;
  if (!factorize(a)) return {normal, std::sqrt(squares / total), normal, u, v};
  solve(a, c);
  for (int j = 0; j < kTerms; ++j) squares -= c[j] * b[j];
  return {.normal = normalized(normal - c[1] * u - c[2] * v),
          .residual = std::sqrt(std::max(squares, 0.0) / total),
          .plane = normal,
          .u = u,
          .v = v,
          .c = c[0],
          .x = c[1],
          .y = c[2],
          .xx = c[3],
          .xy = c[4],
          .yy = c[5]};
}

Vec3 ParaboloidFit::point_at(const Vec3& offset) const {
  const double a = dot(offset, u), b = dot(offset, v);
  const double height = c + (x + xx * a + xy * b) * a + (y + yy * b) * b;
  return offset + (height - dot(offset, plane)) * plane;
}

Vec3 ParaboloidFit::normal_at(const Vec3& offset) const {
  const double a = dot(offset, u), b = dot(offset, v);
  return normalized(plane - (x + 2 * xx * a + xy * b) * u - (y + xy * a + 2 * yy * b) * v);
}

Vec3 perpendicular(const Vec3& n) {
  // The coordinate axis farther from n makes the cross product well-conditioned.
  return normalized(cross(n, std::abs(n.x) <= 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
}

}  // namespace rholm
