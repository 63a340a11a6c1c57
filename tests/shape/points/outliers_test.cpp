// Points that do not belong to a surface.
#include "shape/points/outliers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "rholm/points.h"
#include "rholm/primitives.h"
#include "support/test_points.h"

namespace rholm {
namespace {

using test::random_direction;
using test::random_in;
using test::random_normal;

// Returns flags in the order of the cloud.
std::vector<std::uint8_t> outliers_of(const PointCloud& cloud, double noise,
                                      const Context& context = {}) {
  const test::OrderedCloud ordered(cloud);
  return ordered.as_given(
      find_outliers(ordered.tree, ordered.points, ordered.normals, noise, context));
}

std::size_t count(const std::vector<std::uint8_t>& flags, std::size_t begin, std::size_t end) {
  std::size_t n = 0;
  for (std::size_t i = begin; i < end; ++i) n += flags[i];
  return n;
}

TEST(Outliers, a_clean_sphere_has_none) {
  const auto flags = outliers_of(test::sphere_points(10000), 0);
  // Random points leave gaps: one point in ten thousand may look isolated.
  EXPECT_LE(count(flags, 0, flags.size()), 1U);
}

TEST(Outliers, isolated_points_are_found_and_the_surface_is_not_lost) {
  const std::size_t n = 10000, isolated = 1000;
  PointCloud cloud = test::sphere_points(n);
  for (std::size_t i = 0; i < isolated; ++i) {
    cloud.points.push_back({random_in(-1.2, 1.2, 2, 3 * i), random_in(-1.2, 1.2, 2, 3 * i + 1),
                            random_in(-1.2, 1.2, 2, 3 * i + 2)});
    cloud.normals.push_back(random_direction(3, i));
  }
  const auto flags = outliers_of(cloud, 0);
  EXPECT_LT(count(flags, 0, n), n / 500);
  std::size_t off_surface = 0, found = 0;
  for (std::size_t i = n; i < n + isolated; ++i) {
    // Within two spacings of the surface a normal may agree by chance.
    if (std::abs(norm(cloud.points[i]) - 1) < 2 * std::sqrt(4 * std::numbers::pi / n)) continue;
    ++off_surface;
    found += flags[i];
  }
  // In the first of three passes, random normals agree with five of sixteen neighbours once in
  // twenty.
  EXPECT_GT(static_cast<double>(found), 0.9 * static_cast<double>(off_surface));
}

TEST(Outliers, noise_that_is_known_makes_none) {
  const double sigma = 0.01;
  PointCloud cloud = test::sphere_points(10000);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    cloud.points[i] *= 1 + sigma * random_normal(4, i);
  }
  const auto flags = outliers_of(cloud, sigma);
  EXPECT_LT(count(flags, 0, flags.size()), 20U);
}

TEST(Outliers, uneven_density_and_two_sheets_are_no_reason) {
  PointCloud cloud;
  for (std::uint64_t i = 0; cloud.points.size() < 8000; ++i) {
    const Vec3 u = random_direction(5, i);
    if (random_in(0, 1, 6, i) < std::pow(100, (u.z - 1) / 2)) cloud.points.push_back(u);
  }
  cloud.normals = cloud.points;
  EXPECT_LT(count(outliers_of(cloud, 0), 0, cloud.points.size()), 10U);
  PointCloud plate;
  for (std::uint64_t i = 0; i < 8000; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    plate.points.push_back({random_in(-1, 1, 7, i), random_in(-1, 1, 8, i), 0.005 * side});
    plate.normals.push_back({0, 0, side});
  }
  // Half of the 16 neighbours are on the other side: fewer than 5 are not for 1 in 26, or 307 +-
  // 17.
  EXPECT_LT(count(outliers_of(plate, 0), 0, plate.points.size()), 400U);
}

TEST(Outliers, wrong_normals_are_told_from_those_of_edges_and_thin_parts) {
  const auto share = [](const PointCloud& cloud) {
    const test::OrderedCloud ordered(cloud);
    const std::size_t n = cloud.points.size(), asked = std::min<std::size_t>(n, 2000);
    std::vector<Neighbor> near;
    double wrong = 0;
    for (std::size_t s = 0; s < asked; ++s) {
      wrong += has_wrong_normal(ordered.tree, ordered.normals, s * n / asked, near) ? 1 : 0;
    }
    return wrong / static_cast<double>(asked);
  };
  // Random directions within 45 degrees (15 %) do not contradict their neighbours.
  PointCloud sphere = test::sphere_points(10000);
  for (std::size_t i = 0; i < 10000; i += 10) sphere.normals[i] = random_direction(9, i);
  EXPECT_NEAR(share(sphere), 0.085, 0.02);
  EXPECT_EQ(share(test::sphere_points(10000)), 0);
  EXPECT_LT(share(sample_surface(box({1, 1, 1}), {.points = 2000})), 0.002);
  EXPECT_EQ(share(sample_surface(box({1, 1, 0.01}), {.points = 5000})), 0);
}

TEST(Outliers, few_points_and_equal_ones_are_survived) {
  for (const std::size_t n : {1, 2, 3, 16, 17}) {
    EXPECT_EQ(outliers_of(test::sphere_points(n), 0).size(), n);
  }
  const PointCloud same{.points = std::vector<Vec3>(200, {1, 2, 3}),
                        .normals = std::vector<Vec3>(200, {0, 0, 1}),
                        .attributes = {}};
  EXPECT_EQ(count(outliers_of(same, 0), 0, 200), 0U);
}

TEST(Outliers, are_the_same_for_every_number_of_threads) {
  PointCloud cloud = test::sphere_points(6000);
  for (std::size_t i = 0; i < 6000; i += 3) cloud.normals[i] = random_direction(9, i);
  EXPECT_EQ(outliers_of(cloud, 0, {.threads = 1}), outliers_of(cloud, 0, {.threads = 2}));
}

}  // namespace
}  // namespace rholm
