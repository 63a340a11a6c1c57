// Delaunay triangulations of directions.
#include "paper/patches/sphere_delaunay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "rholm/error.h"
#include "rholm/primitives.h"
#include "support/random_data.h"

namespace rholm {
namespace {

const DelaunayOptions kHull{.gap = INFINITY};

std::vector<Triangle> canonical(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// Returns the sum of solid angles (Van Oosterom and Strackee).
double solid_angle(const std::vector<Vec3>& u, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    sum += 2 * std::atan2(dot(u[a], cross(u[b], u[c])),
                          1 + dot(u[a], u[b]) + dot(u[b], u[c]) + dot(u[c], u[a]));
  }
  return sum;
}

// The octant x, y, z > 0: random directions, its corners, and points on its sides.
std::vector<Vec3> octant(std::size_t n) {
  std::vector<Vec3> points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int k = 1; k < 8; ++k) {
    const double c = std::cos(k * std::numbers::pi / 16), s = std::sin(k * std::numbers::pi / 16);
    points.insert(points.end(), {{c, s, 0}, {0, c, s}, {s, 0, c}});
  }
  for (std::uint64_t i = 0; points.size() < n; ++i) {
    const Vec3 u = test::random_direction(5, i);
    points.push_back({std::abs(u.x), std::abs(u.y), std::abs(u.z)});
  }
  return points;
}

// The triangles are nearly equilateral, so that the circle of each triangle is empty.
TEST(SphereDelaunay, directions_of_an_icosphere_give_its_triangles) {
  for (const int subdivisions : {0, 1, 3}) {
    const Mesh mesh = icosphere(subdivisions);
    EXPECT_EQ(sphere_delaunay(mesh.vertices), canonical(mesh.faces));
  }
}

TEST(SphereDelaunay, no_direction_lies_within_the_circle_of_a_triangle) {
  std::vector<Vec3> u;
  u.reserve(300);
  for (std::uint64_t i = 0; i < 300; ++i) u.push_back(test::random_direction(1, i));
  const std::vector<Triangle> triangles = sphere_delaunay(u, kHull);
  ASSERT_EQ(triangles.size(), 2 * u.size() - 4);  // Euler's formula
  for (const auto& [a, b, c] : triangles) {
    const Vec3 normal = normalized(cross(u[b] - u[a], u[c] - u[a]));
    for (const Vec3& other : u) ASSERT_LE(dot(normal, other - u[a]), 1e-14);
  }
  EXPECT_NEAR(solid_angle(u, triangles), 4 * std::numbers::pi, 1e-11);
}

TEST(SphereDelaunay, the_solid_angle_is_that_of_the_convex_patch) {
  for (const std::size_t n : {24, 60, 1000}) {
    const std::vector<Vec3> points = octant(n);
    std::vector<Vec3> stretched = points;
    for (std::size_t i = 0; i < n; ++i) stretched[i] *= test::random_in(0.1, 10, 2, i);
    const std::vector<Triangle> triangles = sphere_delaunay(stretched, kHull);
    EXPECT_NEAR(solid_angle(points, triangles), std::numbers::pi / 2, 1e-12);
  }
}

// A disc of a hexagonal grid with one distant point, whose triangles are long.
TEST(SphereDelaunay, long_triangles_go_at_the_border_but_not_inside) {
  const double step = 0.03;
  std::vector<Vec3> grid;
  for (int i = -10; i <= 10; ++i) {
    for (int k = -10; k <= 10; ++k) {
      const double x = step * (i + 0.5 * k), y = step * k * std::sqrt(0.75);
      // The hole in the middle is 6 steps wide; its rim does not lie on one circle.
      const double r = std::hypot(x, y) / step;
      const double shift = r < 5 ? 0.1 * step * std::sin(7 * i + 11 * k) : 0;
      if (r < 9.5 && r > 2.9) grid.push_back({x + shift, y - shift, 1});
    }
  }
  const std::vector<Triangle> whole = sphere_delaunay(grid, kHull);
  // No border triangle of the disc's convex hull is three steps wide: none is removed.
  EXPECT_EQ(sphere_delaunay(grid), whole);
  std::vector<Vec3> with_far = grid;
  with_far.push_back({1, 0, 1});
  EXPECT_GT(sphere_delaunay(with_far, kHull).size(), whole.size());
  // Circles of the distant point may have removed slivers at the border of the disc.
  const std::vector<Triangle> kept = sphere_delaunay(with_far);
  EXPECT_TRUE(std::includes(whole.begin(), whole.end(), kept.begin(), kept.end()));
  EXPECT_GT(kept.size() + 6, whole.size());
}

TEST(SphereDelaunay, directions_without_triangles_have_none) {
  EXPECT_TRUE(sphere_delaunay({}).empty());
  std::vector<Vec3> circle;
  circle.reserve(12);
  for (int i = 0; i < 12; ++i) circle.push_back({std::cos(i), std::sin(i), 0});
  EXPECT_TRUE(sphere_delaunay(std::span(circle).first(2)).empty());
  EXPECT_TRUE(sphere_delaunay(circle).empty());
  EXPECT_TRUE(sphere_delaunay(std::vector<Vec3>(10, {1, 2, 3})).empty());
  const std::vector<Vec3> three = {{1e-200, 0, 0}, {0, 1e200, 0}, {0, 0, 1}};
  EXPECT_EQ(sphere_delaunay(three), (std::vector<Triangle>{{0, 1, 2}}));
}

// The rim of a hemisphere is a closed circle: its inner side is flat and is removed.
TEST(SphereDelaunay, a_hemisphere_is_covered_once) {
  std::vector<Vec3> points = {{0, 0, 1}};
  for (int k = 0; k < 16; ++k) {
    const double phi = k * std::numbers::pi / 8;
    points.push_back({std::cos(phi), std::sin(phi), 0});
    points.push_back({std::cos(phi), std::sin(phi), 1});
  }
  const std::vector<Triangle> triangles = sphere_delaunay(points, kHull);
  for (Vec3& p : points) p = normalized(p);
  EXPECT_NEAR(solid_angle(points, triangles), 2 * std::numbers::pi, 1e-12);
}

TEST(SphereDelaunay, a_repeated_direction_belongs_to_no_triangle) {
  std::vector<Vec3> points = octant(60);
  points.push_back(points[30]);
  const std::vector<Triangle> triangles = sphere_delaunay(points, kHull);
  EXPECT_NEAR(solid_angle(points, triangles), std::numbers::pi / 2, 1e-12);
}

TEST(SphereDelaunay, refuses_directions_that_are_none) {
  EXPECT_THROW(sphere_delaunay(std::vector<Vec3>{{0, 0, 1}, {0, 0, 0}}), Error);
  EXPECT_THROW(sphere_delaunay(std::vector<Vec3>{{0, 0, 1}, {0, INFINITY, 0}}), Error);
}

}  // namespace
}  // namespace rholm
