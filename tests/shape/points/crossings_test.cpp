// Intersecting sheets, and shapes that resemble them.
#include "shape/points/crossings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "rholm/topology.h"
#include "support/sizes.h"
#include "support/test_points.h"

namespace rholm {
namespace {

using test::OrderedCloud;
using test::points_of;
using test::random_direction;
using test::random_normal;
using test::uniform;

// Returns two squares of edge 2 that intersect in their middle lines at an angle.
std::vector<Vec3> crossing_squares(std::size_t n, double angle) {
  return points_of(n, [&](std::size_t i) {
    const double along = uniform(1, i), across = uniform(2, i);
    if (i % 2 == 0) return Vec3{along, across, 0};
    return Vec3{along, across * std::cos(angle), across * std::sin(angle)};
  });
}

std::vector<Vec3> two_spheres(std::size_t n, double apart) {
  return points_of(n, [&](std::size_t i) {
    return random_direction(3, i) + Vec3{i % 2 == 0 ? 0 : apart, 0, 0};
  });
}

std::vector<Vec3> noisy(std::vector<Vec3> points, double noise) {
  const double d = noise * bounds(points).diagonal();
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] += d * Vec3{random_normal(11, i), random_normal(12, i), random_normal(13, i)};
  }
  return points;
}

CrossingSearch search_of(const std::vector<Vec3>& points, double noise) {
  const double diagonal = bounds(points).diagonal();
  return {.n = points.size(), .diagonal = diagonal, .noise = noise * diagonal};
}

// The noise is in units of the diagonal.
Crossings look(const std::vector<Vec3>& points, double noise = 0, int threads = 1) {
  const OrderedCloud cloud(points);
  const SamplingGaps gaps = find_gaps(cloud.tree, cloud.points, {}, {});
  Context context;
  context.threads = threads;
  return find_crossings(cloud.tree, cloud.points, gaps, {}, search_of(points, noise), context);
}

// The lengths are 2 and the circumference of a circle of radius 0.6. Noise of 1 % needs balls in
// which spheres are not close to paraboloids, so that less is found there.
TEST(crossings, of_planes_and_spheres_are_about_as_long_as_they_are) {
  for (const std::size_t n : {800, 4000}) {
    for (const double noise : {0.0, 0.005, 0.01}) {
      for (const double angle : {std::numbers::pi / 2, std::numbers::pi / 4}) {
        const double found = look(noisy(crossing_squares(n, angle), noise), noise).length;
        EXPECT_GT(found, 2.0 / 3) << n << " " << noise << " " << angle;
        EXPECT_LT(found, 4) << n << " " << noise << " " << angle;
      }
      const double circle = 2 * std::numbers::pi * 0.6;
      const std::vector<Vec3> points = noisy(two_spheres(n, 1.6), noise);
      const double found = look(points, noise).length;
      EXPECT_GT(found, noise < 0.01 ? circle / 3 : 0) << n << " " << noise;
      EXPECT_LT(found, circle * 2) << n << " " << noise;
    }
  }
}

TEST(crossings, are_named_by_points_near_them) {
  const Crossings found = look(crossing_squares(4000, std::numbers::pi / 2));
  ASSERT_EQ(found.named(), kNamedCrossings);
  for (const Vec3& at : found.at) EXPECT_LT(std::hypot(at.y, at.z), 0.15);  // the spacing is 0.045
}

// Edges of 90 degrees, sheets with borders, a sheet that ends at another sheet, touching spheres.
TEST_OF_TWO_SIZES(crossings, are_not_found_where_sheets_bend_end_or_touch) {
  const auto box = [](std::size_t i) {
    Vec3 p{uniform(1, i), uniform(2, i), uniform(3, i)};
    (i % 3 == 0 ? p.x : i % 3 == 1 ? p.y : p.z) = i % 2 == 0 ? 1 : -1;
    return p;
  };
  const auto tee = [](std::size_t i) {
    const double x = uniform(1, i), y = uniform(2, i);
    return i % 2 == 0 ? Vec3{x, y, 0} : Vec3{x, 0, std::abs(y)};
  };
  const auto sheet = [](std::size_t i) { return Vec3{uniform(1, i), uniform(2, i), 0}; };
  for (const std::size_t n : nightly ? std::vector{800, 4000} : std::vector{800}) {
    const std::vector<std::vector<Vec3>> clouds = {points_of(n, box), points_of(n, tee),
                                                   points_of(n, sheet), two_spheres(n, 2),
                                                   two_spheres(n, 0)};
    for (std::size_t k = 0; k < clouds.size(); ++k) {
      for (const double noise : {0.0, 0.005, 0.01}) {
        const std::vector<Vec3> points = noisy(clouds[k], noise);
        EXPECT_LT(look(points, noise).length, 0.05 * bounds(points).diagonal())
            << n << " " << k << " " << noise;
      }
    }
  }
}

TEST(crossings, are_the_same_in_parts_and_by_any_number_of_threads) {
  const std::vector<Vec3> points = noisy(two_spheres(6000, 1), 0.005);
  const CrossingSearch search = search_of(points, 0.005);
  const Crossings whole = look(points, 0.005), threads = look(points, 0.005, 3);
  EXPECT_EQ(threads.length, whole.length);
  Crossings parts;
  for (int part = 0; part < 3; ++part) {
    const auto is_own = [&](const Vec3& p) { return (p.y < -0.1 ? 0 : p.y < 0.2 ? 1 : 2) == part; };
    std::vector<Vec3> some;
    for (const Vec3& p : points) {
      if (std::abs(p.y - 0.05) < 0.7 || is_own(p)) some.push_back(p);
    }
    const OrderedCloud cloud(some);
    std::vector<std::uint8_t> foreign;
    foreign.reserve(cloud.points.size());
    for (const Vec3& p : cloud.points) foreign.push_back(is_own(p) ? 0 : 1);
    parts.add(find_crossings(cloud.tree, cloud.points, {}, foreign, search, {}));
  }
  EXPECT_GT(whole.found, 10U);
  EXPECT_EQ(parts.found, whole.found);
  EXPECT_NEAR(parts.length, whole.length, 1e-12 * whole.length);
  EXPECT_EQ(parts.at, whole.at);
}

// The noise is too large, and the points are too few.
TEST(crossings, are_not_looked_for_in_noise_beyond_a_local_ball) {
  EXPECT_EQ(look(crossing_squares(4000, std::numbers::pi / 2), 0.05).found, 0U);
  EXPECT_EQ(look(crossing_squares(40, std::numbers::pi / 2)).found, 0U);
}

}  // namespace
}  // namespace rholm
