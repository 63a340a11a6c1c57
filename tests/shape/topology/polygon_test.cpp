#include "rholm/polygon.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>

namespace rholm {
namespace {

std::vector<std::uint32_t> all_corners(std::size_t n) {
  std::vector<std::uint32_t> corners(n);
  std::iota(corners.begin(), corners.end(), 0);
  return corners;
}

std::vector<Triangle> triangulate(const std::vector<Vec3>& points) {
  std::vector<Triangle> triangles;
  triangulate_polygon(points, all_corners(points.size()), triangles);
  return triangles;
}

Vec3 area_vector(const std::vector<Vec3>& p, const Triangle& t) {
  return 0.5 * cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
}

// A triangulation of a flat simple polygon is correct under two conditions. Every triangle faces
// like the polygon, and the areas add up to the polygon's (shoelace formula): then no triangles
// overlap.
void expect_tiles(const std::vector<Vec3>& p) {
  const std::vector<Triangle> triangles = triangulate(p);
  EXPECT_EQ(triangles.size(), p.size() - 2);
  Vec3 polygon;
  for (std::size_t i = 0; i < p.size(); ++i) polygon += 0.5 * cross(p[i], p[(i + 1) % p.size()]);
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = area_vector(p, t);
    EXPECT_GE(dot(a, polygon), 0) << t[0] << ' ' << t[1] << ' ' << t[2];
    sum += norm(a);
  }
  EXPECT_NEAR(sum, norm(polygon), 1e-12 * norm(polygon));
}

// Tests a polygon in six planes: the coordinate planes from both sides, tilted.
void expect_tiles_in_every_plane(const std::vector<Vec3>& flat) {
  for (int plane = 0; plane < 6; ++plane) {
    std::vector<Vec3> p;
    for (const Vec3& q : flat) {
      const double u = q.x, v = plane % 2 == 0 ? q.y : -q.y;
      const double w = 3 + 0.25 * u - 0.125 * v;
      p.push_back(plane / 2 == 0 ? Vec3{u, v, w} : plane / 2 == 1 ? Vec3{v, w, u} : Vec3{w, u, v});
    }
    SCOPED_TRACE(plane);
    expect_tiles(p);
  }
}

TEST(triangulate_polygon, fewer_than_three_corners_give_nothing) {
  EXPECT_TRUE(triangulate({}).empty());
  EXPECT_TRUE(triangulate({{0, 0, 0}, {1, 0, 0}}).empty());
}

TEST(triangulate_polygon, triangle_stays_as_it_is) {
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(triangulate_polygon, quadrilateral_is_cut_along_the_shorter_diagonal) {
  EXPECT_EQ(triangulate({{0, 0, 0}, {9, 1, 0}, {10, 10, 0}, {1, 9, 0}}),
            (std::vector<Triangle>{{1, 2, 3}, {1, 3, 0}}));
  EXPECT_EQ(triangulate({{1, 1, 0}, {10, 0, 0}, {9, 9, 0}, {0, 10, 0}}),
            (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(triangulate_polygon, quadrilateral_with_a_dent_is_cut_inside_though_that_is_longer) {
  // An arrowhead: the reflex corner is 3, then 2, 1, 0; the short diagonal lies outside.
  for (std::size_t shift = 0; shift < 4; ++shift) {
    const std::vector<Vec3> arrow = {{-2, -1, 0}, {0, 8, 0}, {2, -1, 0}, {0, 0, 0}};
    std::vector<Vec3> p;
    p.reserve(4);
    for (std::size_t i = 0; i < 4; ++i) p.push_back(arrow[(i + shift) % 4]);
    SCOPED_TRACE(shift);
    expect_tiles_in_every_plane(p);
  }
}

TEST(triangulate_polygon, convex_polygon_is_a_fan) {
  std::vector<Vec3> p;
  for (int i = 0; i < 7; ++i) {
    const double a = 2 * std::numbers::pi * i / 7;
    p.push_back({std::cos(a), std::sin(a), 0});
  }
  EXPECT_EQ(triangulate(p),
            (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}}));
  expect_tiles_in_every_plane(p);
}

TEST(triangulate_polygon, concave_polygons_are_tiled_exactly) {
  // The polygons are an L, a comb and a spiral.
  expect_tiles_in_every_plane({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
  std::vector<Vec3> comb = {{20, -1, 0}, {20, 4, 0}};
  for (int i = 19; i > 0; --i) comb.push_back({double(i), i % 2 == 1 ? 0.0 : 4.0, 0});
  comb.push_back({0, 4, 0});
  comb.push_back({0, -1, 0});
  expect_tiles_in_every_plane(comb);
  std::vector<Vec3> spiral;
  for (int i = 0; i <= 100; ++i) {
    const double a = 6 * std::numbers::pi * i / 100;
    spiral.push_back({(2 + a) * std::cos(a), (2 + a) * std::sin(a), 0});
  }
  for (int i = 100; i >= 0; --i) {
    const double a = 6 * std::numbers::pi * i / 100;
    spiral.push_back({(1 + a) * std::cos(a), (1 + a) * std::sin(a), 0});
  }
  expect_tiles_in_every_plane(spiral);
}

TEST(triangulate_polygon, hole_joined_by_a_slit_is_tiled_exactly) {
  expect_tiles_in_every_plane({{0, 0, 0},
                               {4, 0, 0},
                               {4, 4, 0},
                               {0, 4, 0},
                               {0, 0, 0},
                               {1, 1, 0},
                               {1, 3, 0},
                               {3, 3, 0},
                               {3, 1, 0},
                               {1, 1, 0}});
}

TEST(triangulate_polygon, corners_on_a_side_do_not_overlap) {
  expect_tiles_in_every_plane({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}});
}

TEST(triangulate_polygon, scale_does_not_matter) {
  for (const double scale : {1e-300, 1e-160, 1e160, 1e300}) {
    const std::vector<Vec3> shape = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0},
                                     {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
    std::vector<Vec3> scaled;
    scaled.reserve(shape.size());
    for (const Vec3& p : shape) scaled.push_back(scale * p);
    EXPECT_EQ(triangulate(scaled), triangulate(shape)) << scale;
    const std::vector<Vec3> dent = {{-2, -1, 0}, {0, 8, 0}, {2, -1, 0}, {0, 0, 0}};
    scaled.clear();
    for (const Vec3& p : dent) scaled.push_back(scale * p);
    EXPECT_EQ(triangulate(scaled), triangulate(dent)) << scale;
  }
}

TEST(triangulate_polygon, degenerate_polygons_still_give_n_minus_2_triangles) {
  EXPECT_EQ(triangulate(std::vector<Vec3>(4)).size(), 2u);
  EXPECT_EQ(triangulate(std::vector<Vec3>(9)).size(), 7u);
  std::vector<Vec3> line, bow_tie, star;
  for (int i = 0; i < 9; ++i) line.push_back({double(i * i), 2.0 * i * i, 0});
  EXPECT_EQ(triangulate(line).size(), 7u);
  bow_tie = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {1, -1, 0}, {0, 2, 0}};
  EXPECT_EQ(triangulate(bow_tie).size(), 3u);
  for (int i = 0; i < 5; ++i) {
    const double a = 4 * std::numbers::pi * i / 5;
    star.push_back({std::cos(a), std::sin(a), 0});
  }
  EXPECT_EQ(triangulate(star).size(), 3u);
  const double huge = 1.7e308;
  EXPECT_EQ(triangulate(
                {{-huge, -huge, 0}, {huge, -huge, 0}, {huge, huge, 0}, {0, 0, 0}, {-huge, huge, 0}})
                .size(),
            3u);
}

TEST(triangulate_polygon, million_corners_do_not_hang) {
  std::vector<Vec3> comb;
  comb.reserve(1'000'001);
  for (int i = 0; i < 1'000'000; ++i) comb.push_back({double(i), i % 2 == 0 ? 0.0 : 1.0, 0});
  comb.push_back({1e6, -1, 0});
  comb.push_back({0, -1, 0});
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(triangulate(comb).size(), comb.size() - 2);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(triangulate_polygon, largest_polygon_that_is_clipped_takes_milliseconds) {
  std::vector<Vec3> comb;  // clockwise teeth: many reflex corners
  const int n = static_cast<int>(kMaxClippedCorners) - 2;
  for (int i = n; i-- > 0;) comb.push_back({double(i), i % 2 == 0 ? 0.0 : 1.0, 0});
  comb.push_back({0, -1, 0});
  comb.push_back({double(n), -1, 0});
  const auto start = std::chrono::steady_clock::now();
  expect_tiles(comb);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

}  // namespace
}  // namespace rholm
