// The variance of one triangle's estimate follows from pairs of points and their contributions
// Omega r conj(Y)(u). It is half the mean square of the difference of two contributions, divided by
// the number of points. Summed over all coefficients, the addition theorem gives
//   Omega^2 / 2 (r1^2 K(1) + r2^2 K(1) - 2 r1 r2 K(u1 . u2)),  K(t) = sum_l (2l+1)/(4 pi) P_l(t).
// Triangles are independent: their variances add up.
#include "expected_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/random.h"
#include "paper/monte_carlo/spherical_triangle.h"
#include "transform/geometry/star_geometry.h"

namespace rholm::paper {
namespace {

// Chosen: the largest number of triangles, taken evenly from the mesh, and pairs of points on each.
// The resulting errors of the mean are both below 1 % on the meshes of Table 1.
constexpr std::size_t kMostTriangles = 40'000;
constexpr int kPairs = 4;

double kernel(int degree, double t) {
  double before = 1, now = t, sum = 1 + (degree > 0 ? 3 * t : 0);
  for (int l = 2; l <= degree; ++l) {
    const double next = ((2 * l - 1) * t * now - (l - 1) * before) / l;
    before = now;
    now = next;
    sum += (2 * l + 1) * now;
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace

double expected_triangle_error(const StarChart& chart, int degree, int samples) {
  const StarGeometry geometry = star_geometry(chart);
  const std::size_t n = geometry.faces.size();
  const std::size_t stride = std::max<std::size_t>(1, n / kMostTriangles);
  const double one = kernel(degree, 1);
  double sum = 0, seen = 0;
  std::uint64_t counter = 0;
  for (std::size_t t = 0; t < n; t += stride, ++seen) {
    const FaceGeometry& face = geometry.faces[t];
    if (face.degenerate || face.solid_angle == 0) continue;
    std::array<Vec3, 3> corners = geometry.corners(t);
    if (face.solid_angle < 0) std::swap(corners[1], corners[2]);  // seen from behind
    const SphericalTriangle triangle = spherical_triangle(corners, std::abs(face.solid_angle));
    const Vec3 normal = normalized(face.twice_area);
    for (int pair = 0; pair < kPairs; ++pair) {
      Vec3 u[2];
      double r[2];
      for (int i = 0; i < 2; ++i) {
        u[i] = uniform_direction(triangle, random_uniform(1, counter), random_uniform(2, counter));
        r[i] = face.d / dot(normal, u[i]);
        ++counter;
      }
      // For unit vectors that nearly agree, 1 - |u - v|^2 / 2 keeps the digits.
      const Vec3 apart = u[1] - u[0];
      const double t12 = 1 - dot(apart, apart) / 2;
      sum += face.solid_angle * face.solid_angle / 2 *
             (r[0] * r[0] * one + r[1] * r[1] * one - 2 * r[0] * r[1] * kernel(degree, t12)) /
             kPairs;
    }
  }
  return std::sqrt(sum / seen * static_cast<double>(n) / samples) / geometry.scale;
}

}  // namespace rholm::paper
