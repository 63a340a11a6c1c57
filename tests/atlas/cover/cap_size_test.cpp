// The best number of points for a cap and the noise of the points, tested on spheres of known
// noise.
#include "atlas/cover/cap_size.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "support/test_points.h"

namespace rholm {
namespace {

using test::random_normal;

struct Ordered {
  std::unique_ptr<PointTree> tree;
  std::vector<Vec3> points, normals;
  OrderedPoints view() const { return {*tree, points, normals}; }
};

Ordered ordered(const PointCloud& cloud) {
  Ordered result;
  result.tree = std::make_unique<PointTree>(cloud.points);
  for (const std::uint32_t i : result.tree->order()) {
    result.points.push_back(cloud.points[i]);
    result.normals.push_back(cloud.normals[i]);
  }
  return result;
}

// Moves points of a sphere along normals, and turns normals by angles about random tangents.
PointCloud noisy_sphere(std::size_t n, double sigma, double angle) {
  PointCloud cloud = test::sphere_points(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 u = cloud.points[i];
    cloud.points[i] = (1 + sigma * random_normal(2, i)) * u;
    const Vec3 axis = normalized(cross(u, test::random_direction(3, i)));
    const double turn = angle * random_normal(4, i);
    cloud.normals[i] = std::cos(turn) * u + std::sin(turn) * cross(axis, u);
  }
  return cloud;
}

constexpr std::size_t kPoints = 5000;
const double kSpacing = std::sqrt(4 * std::numbers::pi / kPoints);

TEST(CapSize, clean_points_have_no_noise) {
  const CapSize size = choose_cap_size(ordered(test::sphere_points(kPoints)).view(), 3, {});
  EXPECT_EQ(size.noise, 0);
  EXPECT_LT(size.normal_noise, 0.01);
}

TEST(CapSize, exact_caps_do_not_grow_beyond_the_other_side_of_a_plate) {
  // Points on both sides of a square plate of 2 x 2. Its thickness is four spacings of the points,
  // which is also the radius of a circle with 50 points.
  constexpr double kApart = 4 * 0.04;
  PointCloud plate;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    plate.points.push_back(
        {test::random_in(-1, 1, 5, i), test::random_in(-1, 1, 6, i), side * kApart / 2});
    plate.normals.push_back({0, 0, side});
  }
  const std::size_t thin = choose_cap_size(ordered(plate).view(), 3, {}).neighbours;
  EXPECT_GE(thin, 24U);
  EXPECT_LE(thin, 81U);
  for (Vec3& p : plate.points) p.z *= 10;
  EXPECT_GT(choose_cap_size(ordered(plate).view(), 3, {}).neighbours, 81U);
}

// The noise is a small part of the spacing or half of it, with exact or inexact normals.
TEST(CapSize, noise_of_a_smooth_body_is_found_to_a_tenth) {
  for (const double part : {0.15, 0.5}) {
    for (const double angle : {0.0, 0.1}) {
      SCOPED_TRACE(std::to_string(part) + " spacings, angle " + std::to_string(angle));
      const double sigma = part * kSpacing;
      const Ordered points = ordered(noisy_sphere(kPoints, sigma, angle));
      const CapSize size = choose_cap_size(points.view(), 3, {});
      EXPECT_NEAR(size.noise, sigma, 0.1 * sigma);
    }
  }
}

TEST(CapSize, noise_of_normals_is_found_to_a_tenth) {
  for (const double angle : {0.05, 0.1}) {
    const Ordered points = ordered(noisy_sphere(kPoints, 0.2 * kSpacing, angle));
    EXPECT_NEAR(choose_cap_size(points.view(), 3, {}).normal_noise, angle, 0.1 * angle);
  }
}

TEST(CapSize, noise_asks_for_larger_caps_than_detail_does) {
  // Ripples are a few spacings long, so that only small caps follow them.
  PointCloud rippled = test::sphere_points(kPoints);
  const double k = 2 * std::numbers::pi / (12 * kSpacing), height = 0.5 * kSpacing;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Vec3 u = rippled.points[i];
    rippled.points[i] = (1 + height * std::sin(k * u.z)) * u;
    const Vec3 up = Vec3{0, 0, 1} - u.z * u;
    rippled.normals[i] = normalized(u - height * k * std::cos(k * u.z) * up);
  }
  const CapSize detail = choose_cap_size(ordered(rippled).view(), 3, {});
  const CapSize noise =
      choose_cap_size(ordered(noisy_sphere(kPoints, height / 2, 0.1)).view(), 3, {});
  EXPECT_LT(detail.neighbours, 60U);
  EXPECT_EQ(detail.noise, 0);
  EXPECT_GT(noise.neighbours, 2 * detail.neighbours);
}

TEST(CapSize, a_parabola_is_least_at_its_vertex_within_the_range) {
  const std::vector<double> x{0, 0.4, 1, 2.5, 3};
  const auto parabola = [&](double bend, double vertex) {
    std::vector<double> y;
    y.reserve(x.size());
    for (const double at : x) y.push_back(3 + bend * (at - vertex) * (at - vertex));
    return y;
  };
  EXPECT_NEAR(least_of_parabola(x, parabola(2, 1.3)), 1.3, 1e-12);
  EXPECT_EQ(least_of_parabola(x, parabola(2, -1)), 0);
  EXPECT_EQ(least_of_parabola(x, parabola(2, 5)), 3);
  EXPECT_TRUE(std::isnan(least_of_parabola(x, parabola(-2, 1.3))));
  EXPECT_TRUE(std::isnan(least_of_parabola({{1.0, 2.0}}, {{3.0, 4.0}})));
  EXPECT_TRUE(std::isnan(least_of_parabola({}, {})));
  // Errors that are orthogonal to 1, x and x^2 change nothing: third differences of equal steps.
  const std::vector<double> even{0, 1, 2, 3};
  EXPECT_NEAR(least_of_parabola(even, std::vector<double>{1 + 0.1, 0 - 0.3, 1 + 0.3, 4 - 0.1}), 1,
              1e-12);
}

TEST(CapSize, is_the_same_for_every_number_of_threads) {
  const Ordered points = ordered(noisy_sphere(2000, 0.01, 0.1));
  const CapSize one = choose_cap_size(points.view(), 3, {.threads = 1});
  const CapSize two = choose_cap_size(points.view(), 3, {.threads = 2});
  EXPECT_EQ(one.neighbours, two.neighbours);
  EXPECT_EQ(one.noise, two.noise);
  EXPECT_EQ(one.gradient_weight, two.gradient_weight);
}

}  // namespace
}  // namespace rholm
