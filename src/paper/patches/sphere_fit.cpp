#include "paper/patches/sphere_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rholm {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

Vec3 mean_of(std::span<const Vec3> points) {
  Vec3 sum;
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

double largest_distance(std::span<const Vec3> points, const Vec3& from) {
  double largest = 0;
  for (const Vec3& p : points) largest = std::max(largest, norm(p - from));
  return largest;
}

// Solves for a symmetric positive matrix; empty if it is singular. Pivots are at least the least
// eigenvalue, and where this is 0 rounding leaves about 1e-15 of the trace.
std::optional<Vec3> solve(Matrix3 a, std::array<double, 3> b) {
  const double least = 1e-12 * (a[0][0] + a[1][1] + a[2][2]);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(a[k][k] > least)) return std::nullopt;
    for (std::size_t i = k + 1; i < 3; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < 3; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  std::array<double, 3> x{};
  for (std::size_t k = 3; k-- > 0;) {
    x[k] = b[k];
    for (std::size_t j = k + 1; j < 3; ++j) x[k] -= a[k][j] * x[j];
    x[k] /= a[k][k];
  }
  return Vec3{x[0], x[1], x[2]};
}

PatchSphere seen_from(const PatchPoints& patch, const Sphere& sphere, const Vec3& middle) {
  return {.sphere = sphere,
          .axis = normalized(middle - sphere.center),
          .star_cosine = star_cosine(patch, sphere.center)};
}

}  // namespace

// This differs from (P38): in coordinates q about the mean of the points, rho and c separate. With
// sum q = 0 the normal equations are 2 (sum q q^T) c = sum q |q|^2 and rho = -mean |q|^2.
std::optional<Sphere> fit_sphere(std::span<const Vec3> points) {
  if (points.size() < 4) return std::nullopt;
  const Vec3 mean = mean_of(points);
  const double size = largest_distance(points, mean);
  if (!(size > 0)) return std::nullopt;
  Matrix3 moments{};
  std::array<double, 3> right{};
  double squares = 0;
  for (const Vec3& p : points) {
    const Vec3 offset = (p - mean) / size;
    const std::array<double, 3> q = {offset.x, offset.y, offset.z};
    const double square = dot(offset, offset);
    squares += square;
    for (std::size_t i = 0; i < 3; ++i) {
      right[i] += q[i] * square / 2;
      for (std::size_t k = 0; k < 3; ++k) moments[i][k] += q[i] * q[k];
    }
  }
  const std::optional<Vec3> center = solve(moments, right);
  if (!center) return std::nullopt;
  const double radius2 = dot(*center, *center) + squares / static_cast<double>(points.size());
  if (!std::isfinite(radius2)) return std::nullopt;
  return Sphere{.center = mean + size * *center, .radius = size * std::sqrt(radius2)};
}

Vec3 mean_normal(std::span<const Vec3> normals) {
  Vec3 sum;
  for (const Vec3& n : normals) sum += n;
  return normalized(sum);
}

double star_cosine(const PatchPoints& patch, const Vec3& center) {
  double least = 1;
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    const Vec3 ray = patch.points[i] - center;
    const double length = norm(ray);
    if (!(length > 0)) return -1;
    least = std::min(least, dot(patch.normals[i], ray) / length);
  }
  return least;
}

PatchSphere patch_sphere(const PatchPoints& patch, double star) {
  const Vec3 middle = mean_of(patch.points);
  const double support = largest_distance(patch.points, middle);
  Vec3 up = mean_normal(patch.normals);
  if (up == Vec3{}) up = patch.normals.front();
  // A single point is seen from anywhere.
  const double depth = support > 0 ? support / std::tan(kLeastHalfAngle) : 1;

  const std::optional<Sphere> fitted = fit_sphere(patch.points);
  if (fitted && fitted->radius <= depth) {
    PatchSphere best = seen_from(patch, *fitted, middle);
    best.best_fitting = true;
    if (best.star_cosine > star) return best;  // else the centre is outside or too near
  }
  Sphere below{.center = middle - depth * up};
  for (const Vec3& p : patch.points) below.radius += norm(p - below.center);
  below.radius /= static_cast<double>(patch.points.size());
  return seen_from(patch, below, middle);
}

}  // namespace rholm
