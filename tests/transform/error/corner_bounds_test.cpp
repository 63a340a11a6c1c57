#include "transform/error/corner_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "rholm/primitives.h"

namespace rholm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Computes the bound of one face with angles and cosines.
double slow_bound(const std::array<Vec3, 3>& p, double bend) {
  double longest = 0, nearest = kInfinity, farthest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, norm(p[(i + 1) % 3] - p[i]));
    nearest = std::min(nearest, norm(p[i]));
    farthest = std::max(farthest, norm(p[i]));
  }
  const Vec3 normal = normalized(cross(p[1] - p[0], p[2] - p[0]));
  const double distance = dot(normal, p[0]), cosine = distance / farthest;
  const double s = 0.6 * 1.02 * longest / nearest;
  if (!(distance > 0) || 1.02 * longest / nearest > 0.5) return kInfinity;
  return s * s / 2 * (farthest * (2 / (cosine * cosine) - 1) + bend);
}

TEST(corner_bounds, are_those_of_each_face) {
  Mesh mesh = bumpy_sphere(3);
  const Vec3 center = {0.02, -0.01, 0.03};
  mesh.vertices[5] = 3.0 * mesh.vertices[5];      // long, steep faces
  mesh.faces[7] = {1, 2, 2};                      // without area
  std::swap(mesh.faces[9][0], mesh.faces[9][1]);  // faces inwards
  const MeshView view = view_of(mesh);
  std::size_t infinite = 0;
  for (const std::size_t n : {1UL, 3UL, 8UL, 13UL, 128UL, 131UL, mesh.faces.size()}) {
    std::vector<double> bounds(n + 1, -1);
    corner_bounds(view, 0, n, center, 0.5, 4, bounds.data());
    EXPECT_EQ(bounds[n], -1);
    for (std::size_t t = 0; t < n; ++t) {
      std::array<Vec3, 3> p;
      for (std::size_t i = 0; i < 3; ++i) {
        p[i] = 0.5 * (mesh.vertices[mesh.faces[t][i]] - center);
      }
      const double slow = slow_bound(p, 4);
      if (std::isfinite(slow)) {
        EXPECT_NEAR(bounds[t], slow, 1e-9 * slow) << t;
      } else {
        EXPECT_EQ(bounds[t], kInfinity) << t;
        ++infinite;
      }
    }
  }
  EXPECT_GT(infinite, 4);
}

}  // namespace
}  // namespace rholm
