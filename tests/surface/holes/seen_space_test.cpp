// Emptiness of places, as lines of sight determine it.
#include "surface/holes/seen_space.h"

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "support/test_points.h"

namespace rholm {
namespace {

// A square of points in the plane z = 0, |x|, |y| <= 1, and two points at z = -2 and z = 2, which
// make the box deep.
SeenSpace over_square(const Vec3& sensor, double margin, const Context& context = {}) {
  std::vector<Vec3> points;
  for (int i = -50; i <= 50; ++i) {
    for (int j = -50; j <= 50; ++j) points.push_back({0.02 * i, 0.02 * j, 0});
  }
  const std::size_t n = points.size();
  points.push_back({0, 0, -2});
  points.push_back({0, 0, 2});
  std::vector<Vec3> sensors(points.size(), sensor);
  sensors[n] = points[n], sensors[n + 1] = points[n + 1];  // two points without lines of sight
  return SeenSpace(points, sensors, 0.04, margin, context);
}

TEST(seen_space, is_empty_before_the_points_and_not_behind_or_beside) {
  const SeenSpace seen = over_square({0, 0, 10}, 0.2);
  for (const double x : {-0.7, 0.0, 0.6}) {
    for (const double z : {0.4, 1.0, 1.9}) EXPECT_EQ(seen.emptiness({x, -x / 2, z}), 1) << z;
    for (const double z : {-0.1, -1.0, -1.9}) EXPECT_EQ(seen.emptiness({x, -x / 2, z}), 0) << z;
  }
  // Lines end 0.2 before the plane; the transition takes three cubes.
  EXPECT_EQ(seen.emptiness({0.3, 0.3, 0.08}), 0);
  EXPECT_EQ(seen.emptiness({0.3, 0.3, 0.32}), 1);
  // Far outside, the emptiness is as at the border.
  EXPECT_EQ(seen.emptiness({0, 0, 50}), 1);
  EXPECT_EQ(seen.emptiness({0, 0, -50}), 0);
}

TEST(seen_space, ends_where_the_cone_of_a_near_sensor_does) {
  // From (0, 0, 2), at height z, the square is seen through |x| < 1 - z / 2.
  const SeenSpace seen = over_square({0, 0, 2}, 0.1);
  for (const double z : {0.4, 0.8, 1.2}) {
    const double half = 1 - z / 2;
    EXPECT_EQ(seen.emptiness({half - 0.15, 0, z}), 1) << z;
    EXPECT_EQ(seen.emptiness({half + 0.15, 0, z}), 0) << z;
    // The value at the edge is about a half.
    EXPECT_NEAR(seen.emptiness({half, 0, z}), 0.5, 0.4) << z;
  }
}

// One half of the lines is in one part, the other half in another.
TEST(seen_space, of_parts_is_that_of_all) {
  const PointCloud cloud = test::sphere_points(4000);
  std::vector<Vec3> sensors;
  sensors.reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    sensors.push_back(3 * cloud.points[i] + Vec3{1, i % 2 == 0 ? 1.0 : -1.0, 0});
  }
  const SeenSpace all(cloud.points, sensors, 0.05, 0.1);
  const Bounds box = bounds(cloud.points);
  SeenSpace sum(box, 0.05);
  for (const std::size_t first : {0U, 2000U}) {
    SeenSpace part(box, 0.05);
    part.add_lines(std::span(cloud.points).subspan(first, 2000),
                   std::span(sensors).subspan(first, 2000), 0.1);
    sum.add_cubes(part.cubes());
  }
  sum.smooth();
  for (const Vec3& p : cloud.points) {
    for (const double r : {0.5, 0.9, 1.0, 1.3})
      ASSERT_EQ(sum.emptiness(r * p), all.emptiness(r * p));
  }
}

TEST(seen_space, is_continuous) {
  const SeenSpace seen = over_square({3, 1, 5}, 0.2);
  double before = seen.emptiness({-2, 0.1, 1});
  for (double x = -2; x < 2; x += 1e-3) {
    const double here = seen.emptiness({x, 0.1, 1});
    EXPECT_LE(std::abs(here - before), 1e-3 / 0.04);
    before = here;
  }
}

TEST(seen_space, cubes_are_not_more_than_there_is_memory_for) {
  std::vector<Vec3> points = test::sphere_points(100).points;
  points.push_back({1e6, 0, 0});
  const std::vector<Vec3> sensors(points.size(), Vec3{0, 0, 1e9});
  const SeenSpace seen(points, sensors, 1e-3, 0.1);
  EXPECT_GE(seen.emptiness({0, 0, 0}), 0);
}

}  // namespace
}  // namespace rholm
