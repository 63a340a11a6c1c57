// Isolated points, far from any surface.
#include "shape/points/isolated_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "rholm/points.h"
#include "rholm/primitives.h"
#include "shape/points/normals.h"
#include "support/test_points.h"

namespace rholm {
namespace {

using test::random_direction;
using test::random_in;

// Returns flags in the order of the points.
std::vector<std::uint8_t> isolated_points_of(const std::vector<Vec3>& points,
                                             const Context& context = {}) {
  const test::OrderedCloud ordered(points);
  const SamplingGaps gaps = find_gaps(ordered.tree, ordered.points, {}, context);
  return ordered.as_given(find_isolated_points(ordered.tree, ordered.points, gaps, context));
}

std::size_t count(const std::vector<std::uint8_t>& flags, std::size_t begin, std::size_t end) {
  std::size_t n = 0;
  for (std::size_t i = begin; i < end; ++i) n += flags[i];
  return n;
}

TEST(isolated_points, of_clean_surfaces_there_are_none) {
  const Mesh thin = [] {
    Mesh blade = icosphere(5);
    for (Vec3& v : blade.vertices) v = {3 * v.x, v.y, 0.05 * v.z};
    return blade;
  }();
  for (const Mesh& mesh : {icosphere(4), box({2, 1, 0.3}), torus(2, 0.2, 200, 30), thin}) {
    for (const std::size_t n : {300u, 3000u, 30000u}) {
      const auto flags = isolated_points_of(sample_surface(mesh, {.points = n}).points);
      EXPECT_LE(count(flags, 0, n), n / 10000) << n;
    }
  }
}

TEST(isolated_points, one_is_found_at_any_distance) {
  for (const double distance : {1.5, 10.0, 1e5}) {
    std::vector<Vec3> points = test::sphere_points(3000).points;
    points.push_back({0, 0, distance});
    const auto flags = isolated_points_of(points);
    EXPECT_EQ(flags.back(), 1) << distance;
    EXPECT_EQ(count(flags, 0, 3000), 0U) << distance;
  }
}

TEST(isolated_points, of_a_tenth_of_random_points_those_off_the_surface_are_found) {
  const std::size_t n = 20000, isolated = 2000;
  std::vector<Vec3> points = test::sphere_points(n).points;
  for (std::size_t i = 0; i < isolated; ++i) {
    points.push_back({random_in(-1.2, 1.2, 2, 3 * i), random_in(-1.2, 1.2, 2, 3 * i + 1),
                      random_in(-1.2, 1.2, 2, 3 * i + 2)});
  }
  const auto flags = isolated_points_of(points);
  EXPECT_LE(count(flags, 0, n), n / 1000);
  const double near = 5 * std::sqrt(4 * std::numbers::pi / n);
  std::size_t off = 0, found = 0;
  for (std::size_t i = n; i < points.size(); ++i) {
    if (std::abs(norm(points[i]) - 1) < near) continue;
    ++off;
    found += flags[i];
  }
  EXPECT_GT(off, isolated / 2);
  EXPECT_GT(static_cast<double>(found), 0.95 * static_cast<double>(off));
}

TEST(isolated_points, sparser_parts_rows_and_second_objects_are_none) {
  // A patch in a plane is ten times as dense as the plane.
  std::vector<Vec3> plane;
  plane.reserve(15000);
  for (std::uint64_t i = 0; i < 4000; ++i) {
    plane.push_back({random_in(-3, 3, 1, 2 * i), random_in(-3, 3, 1, 2 * i + 1), 0});
  }
  for (std::uint64_t i = 0; i < 11000; ++i) {
    const Vec3 p = {random_in(-0.5, 0.5, 2, 2 * i), random_in(-0.5, 0.5, 2, 2 * i + 1), 0};
    plane.push_back(p);
  }
  EXPECT_EQ(count(isolated_points_of(plane), 0, plane.size()), 0U);
  const PointCloud rows =
      sample_surface(torus(2, 0.7, 200, 100),
                     {.points = 20000, .pattern = SamplePattern::kRings, .pattern_ratio = 15});
  EXPECT_EQ(count(isolated_points_of(rows.points), 0, rows.points.size()), 0U);
  // A tenth of the points lie on a sphere three times as large, far away.
  std::vector<Vec3> two = test::sphere_points(5000).points;
  for (std::uint64_t i = 0; i < 500; ++i) two.push_back(3 * random_direction(5, i) + Vec3{9, 0, 0});
  EXPECT_EQ(count(isolated_points_of(two), 0, two.size()), 0U);
}

TEST(isolated_points, noise_makes_none) {
  std::vector<Vec3> points = test::sphere_points(10000).points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] *= 1 + 0.02 * test::random_normal(4, i);  // half of the spacing
  }
  EXPECT_LE(count(isolated_points_of(points), 0, points.size()), 10U);
}

// Isolated points, rows with smaller steps along than across, and fewer points than a group has.
TEST(isolated_points, give_the_neighbours_that_are_found_alone) {
  std::vector<Vec3> rows;
  for (int row = 0; row < 30; ++row) {
    for (int i = 0; i < 300; ++i) rows.push_back({0.1 * row, 0.01 * i, 1e-3 * std::sin(7.0 * i)});
  }
  for (const std::vector<Vec3>& points :
       {test::sphere_points(5000).points, rows, test::sphere_points(12).points}) {
    const test::OrderedCloud ordered(points);
    const SamplingGaps gaps = find_gaps(ordered.tree, ordered.points, {}, {});
    std::vector<std::uint32_t> found;
    const auto flags = find_isolated_points(ordered.tree, ordered.points, gaps, {}, &found);
    EXPECT_EQ(found, graph_neighbors(ordered.tree, gaps, {}));
    EXPECT_EQ(flags, find_isolated_points(ordered.tree, ordered.points, gaps, {}));
  }
}

TEST(isolated_points, few_points_are_survived_and_threads_change_nothing) {
  for (const std::size_t n : {1u, 2u, 15u, 16u, 17u, 40u}) {
    EXPECT_EQ(count(isolated_points_of(test::sphere_points(n).points), 0, n), 0U) << n;
  }
  std::vector<Vec3> points = test::sphere_points(5000).points;
  for (std::uint64_t i = 0; i < 500; ++i) points.push_back(2 * random_direction(7, i));
  EXPECT_EQ(isolated_points_of(points, {.threads = 1}), isolated_points_of(points, {.threads = 3}));
}

}  // namespace
}  // namespace rholm
