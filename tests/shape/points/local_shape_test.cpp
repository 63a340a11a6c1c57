// Local shape of points: curve, surface or volume.
#include "shape/points/local_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/test_points.h"

namespace rholm {
namespace {

using test::random_direction;
using test::random_in;
using test::random_normal;

LocalShape look(const std::vector<Vec3>& points, const std::vector<Vec3>& normals = {}) {
  const PointTree tree(points);
  std::vector<Vec3> ordered, out;
  for (const std::uint32_t i : tree.order()) {
    ordered.push_back(points[i]);
    if (!normals.empty()) out.push_back(normals[i]);
  }
  return look_at_shape(tree, ordered, out, {});
}

template <class Place>
std::vector<Vec3> make(std::size_t n, const Place& place) {
  std::vector<Vec3> points;
  points.reserve(n);
  for (std::size_t i = 0; i < n; ++i) points.push_back(place(i));
  return points;
}

// The noise is relative to the radius: 0.087 is 2.5 % of the diagonal of the bounding box.
std::vector<Vec3> noisy_ball(std::size_t n, double noise) {
  return make(n, [&](std::size_t i) {
    return random_direction(1, i) +
           noise * Vec3{random_normal(2, i), random_normal(3, i), random_normal(4, i)};
  });
}

TEST(local_shape, of_surfaces_is_flat_as_soon_as_it_is_wider_than_the_noise) {
  for (const std::size_t n : {400u, 4000u}) {
    for (const double noise : {0.0, 0.01, 0.087}) {
      const LocalShape shape = look(noisy_ball(n, noise));
      EXPECT_EQ(shape.kind, LocalKind::kSurface) << n << " " << noise;
    }
  }
}

TEST(local_shape, of_points_of_a_body_is_a_volume) {
  for (const std::size_t n : {400u, 4000u}) {
    const auto ball = make(
        n, [](std::size_t i) { return std::cbrt(random_in(0, 1, 2, i)) * random_direction(1, i); });
    const auto slab = make(n, [](std::size_t i) {
      return Vec3{random_in(0, 1, 1, i), random_in(0, 1, 2, i), random_in(0, 0.3, 3, i)};
    });
    const auto lattice = make(n, [](std::size_t i) {
      const std::size_t row = i / 8 % 8, layer = i / 64;
      return Vec3{static_cast<double>(i % 8), static_cast<double>(row), static_cast<double>(layer)};
    });
    for (const auto& points : {ball, slab, lattice}) {
      EXPECT_EQ(look(points).kind, LocalKind::kVolume) << n;
    }
    // The normals do not matter.
    const auto radial = make(n, [&](std::size_t i) { return normalized(ball[i]); });
    EXPECT_EQ(look(ball, radial).kind, LocalKind::kVolume) << n;
  }
}

TEST(local_shape, of_a_line_and_a_ring_is_a_curve) {
  for (const std::size_t n : {400u, 4000u}) {
    const auto ring = make(n, [](std::size_t i) {
      const double u = random_in(-3.14, 3.14, 1, i);
      return Vec3{std::cos(u), std::sin(u), 0.002 * random_normal(2, i)};
    });
    const auto line = make(n, [](std::size_t i) {
      return Vec3{random_in(0, 1, 1, i), 0.001 * random_normal(2, i), 0.001 * random_normal(3, i)};
    });
    for (const auto& points : {ring, line}) EXPECT_EQ(look(points).kind, LocalKind::kCurve) << n;
  }
}

TEST(local_shape, says_which_normals_are_not_across_the_surface) {
  const auto points = noisy_ball(2000, 0);
  const auto any = make(2000, [](std::size_t i) { return random_direction(9, i); });
  EXPECT_EQ(look(points, points).crooked, 0);
  // A share of cos(45 degrees) of random directions is more than 45 degrees from a given one.
  EXPECT_NEAR(look(points, any).crooked, std::sqrt(0.5), 0.12);
}

TEST(local_shape, of_few_points_is_not_known) {
  EXPECT_EQ(look(noisy_ball(60, 0)).kind, LocalKind::kUnknown);
}

}  // namespace
}  // namespace rholm
