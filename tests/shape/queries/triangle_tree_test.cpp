#include "shape/queries/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "shape/face.h"
#include "shape/queries/closest_point.h"
#include "support/query_meshes.h"
#include "support/targets.h"

namespace rholm {
namespace {

using test::cube;
using test::random_point;
using test::soup;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Mesh moved(Mesh mesh, double scale, const Vec3& offset) {
  for (Vec3& vertex : mesh.vertices) vertex = scale * vertex + offset;
  return mesh;
}

// Returns the minimum of |x - p| over the triangle, independently of the library. Its barycentric
// quadratic form is minimised region by region (inside, three edges), in long double.
double oracle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  using Real = long double;
  const auto dot3 = [](const Vec3& u, const Vec3& v) {
    return Real(u.x) * v.x + Real(u.y) * v.y + Real(u.z) * v.z;
  };
  const Vec3 e = b - a, f = c - a, w = p - a;
  const Real ee = dot3(e, e), ef = dot3(e, f), ff = dot3(f, f), ew = dot3(e, w), fw = dot3(f, w);
  const auto at = [&](Real s, Real t) {  // squared distance to a + s e + t f
    const Real x = w.x - s * e.x - t * f.x, y = w.y - s * e.y - t * f.y,
               z = w.z - s * e.z - t * f.z;
    return x * x + y * y + z * z;
  };
  const auto clamp = [](Real x) { return x > 0 ? (x < 1 ? x : Real(1)) : Real(0); };
  Real best = at(ee > 0 ? clamp(ew / ee) : 0, 0);
  best = std::min(best, at(0, ff > 0 ? clamp(fw / ff) : 0));
  const Real gg = ee - 2 * ef + ff;  // the third edge: s = 1 - t
  const Real t3 = gg > 0 ? clamp((ee - ef - ew + fw) / gg) : 0;
  best = std::min(best, at(1 - t3, t3));
  const Real determinant = ee * ff - ef * ef;
  if (determinant > 1e-17L * ee * ff) {
    const Real s = (ew * ff - fw * ef) / determinant, t = (fw * ee - ew * ef) / determinant;
    if (s >= 0 && t >= 0 && s + t <= 1) best = std::min(best, at(s, t));
  }
  return static_cast<double>(std::sqrt(best));
}

double brute_force_distance(const Mesh& mesh, const Vec3& p) {
  double best = kInfinity;
  for (const Triangle& t : mesh.faces) {
    best = std::min(
        best, oracle_distance(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]));
  }
  return best;
}

// With coordinates up to 1, differences, squares and the root have errors of a few 2^-53; 1e-14 is
// about fifty.
TEST(closest_point, equals_a_brute_force_search_in_extended_precision) {
  const Mesh mesh = soup(7, 2000);
  const TriangleTree tree(mesh);
  for (int k = 0; k < 3000; ++k) {
    const Vec3 p = (k % 3 == 0 ? 0.01 : 1.5) * random_point(99, k);
    const ClosestPoint found = tree.closest(p);
    ASSERT_NEAR(found.distance, brute_force_distance(mesh, p), 1e-14);
    ASSERT_NEAR(norm(found.point - p), found.distance, 1e-14);
    const Triangle& t = mesh.faces[found.triangle];
    ASSERT_NEAR(
        0,
        oracle_distance(found.point, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]),
        1e-14);
  }
}

// 500 tiny triangles at distances that floats cannot distinguish: the search must look slightly
// farther than the best result. Each triangle occurs 16 times, so that leaves of the tree are
// points.
TEST(closest_point, is_not_lost_in_the_rounding_of_the_tree) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Mesh mesh;
    for (std::uint32_t k = 0; k < 500; ++k) {
      const double radius = 1 + 1e-8 * random_uniform(seed, k);
      mesh.vertices.push_back(radius * normalized(random_point(seed + 100, k)));
      mesh.faces.insert(mesh.faces.end(), 16, {k, k, k});
    }
    const TriangleTree tree(mesh);
    const Vec3 p = 1e-8 * random_point(seed + 200, 0);
    ASSERT_NEAR(tree.closest(p).distance, brute_force_distance(mesh, p), 1e-15);
  }
}

// After a shift by 1000 coordinates are accurate to 1e-13; scales are powers of two and thus exact.
TEST(closest_point, keeps_its_accuracy_at_any_scale_and_place) {
  const Mesh mesh = soup(8, 300);
  const TriangleTree here(mesh);
  for (const double scale : {0x1p-900, 0x1p-30, 1.0, 0x1p30, 0x1p900}) {
    const Mesh scaled = moved(mesh, scale, {});
    const TriangleTree tree(scaled);
    for (int k = 0; k < 100; ++k) {
      const Vec3 p = random_point(5, k);
      ASSERT_NEAR(tree.closest(scale * p).distance / scale, here.closest(p).distance, 1e-14);
    }
  }
  const Vec3 offset = {1000, -1000, 1000};
  const Mesh there = moved(mesh, 1, offset);
  const TriangleTree tree(there);
  for (int k = 0; k < 100; ++k) {
    const Vec3 p = random_point(5, k);
    ASSERT_NEAR(tree.closest(p + offset).distance, here.closest(p).distance, 1e-12);
  }
}

TEST(closest_point, of_far_points_is_exact_or_at_least_finite) {
  const Mesh mesh = cube();
  const TriangleTree tree(mesh);
  for (const double far : {1e3, 1e8, 1e20, 1e100, 1e200, 1e308}) {
    const ClosestPoint found = tree.closest({far, 0, 0});
    EXPECT_DOUBLE_EQ(found.distance, far - 1) << far;
    if (far > 1e15) continue;  // 2^-53 of `far` exceeds the mesh
    EXPECT_EQ(found.point.x, 1) << far;
  }
}

TEST(closest_point, ties_go_to_the_smaller_index) {
  const Mesh mesh = cube();
  const TriangleTree tree(mesh);
  // Triangles 0 and 1 share the diagonal of the bottom; 0, 1, 4, 5, 8, 9 have the corner 0.
  EXPECT_EQ(tree.closest({0.25, 0.25, -3}).triangle, 0u);
  EXPECT_EQ(tree.closest({-2, -2, -2}).triangle, 0u);
  EXPECT_EQ(tree.closest({1.5, 3, 2.25}).triangle, 2u);  // corner 7: 2, 3, 6, 7, 10, 11
  Mesh twice = mesh;
  twice.faces.insert(twice.faces.begin(), mesh.faces.begin(), mesh.faces.end());
  const TriangleTree doubled(twice);
  for (int k = 0; k < 200; ++k) EXPECT_LT(doubled.closest(random_point(3, k)).triangle, 12u);
}

// Flat triangles along the axes are as far away as their boxes, except for rounding. Each triangle
// occurs three times, far apart in the list.
TEST(closest_point, of_equal_triangles_is_on_the_first) {
  Mesh mesh = moved(cube(), 0.7, {0.123, 0.456, 0.789});
  std::vector<Triangle> all;
  for (int k = 0; k < 3; ++k) {
    for (int copy = 0; copy < 100; ++copy) {
      for (const Triangle& t : mesh.faces) {
        const auto first = static_cast<std::uint32_t>(8 * copy);
        all.push_back({first + t[0], first + t[1], first + t[2]});
      }
    }
  }
  const std::vector<Vec3> corners = mesh.vertices;
  for (int copy = 1; copy < 100; ++copy) {
    const Vec3 offset = 3.0 * random_point(21, copy);
    for (const Vec3& corner : corners) mesh.vertices.push_back(corner + offset);
  }
  mesh.faces = all;
  const TriangleTree tree(mesh);
  for (int k = 0; k < 20000; ++k) {
    ASSERT_LT(tree.closest(4.0 * random_point(22, k)).triangle, all.size() / 3);
  }
}

// Portions have any size and any order: each triangle alone, one in seven, halves.
TEST(closest_point, of_portions_is_that_of_the_whole) {
  Mesh mesh = cube();
  const Mesh more = soup(19, 300);
  for (const Triangle& t : more.faces) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.faces.push_back({first, first + 1, first + 2});
    for (const std::uint32_t corner : t) mesh.vertices.push_back(more.vertices[corner]);
  }
  for (const Triangle& t : cube().faces) mesh.faces.push_back(t);  // repeated
  const UnitFrame frame = unit_frame(bounds(mesh.vertices));
  const TriangleTree whole(mesh);
  const std::size_t n = mesh.faces.size();
  for (const std::size_t step : {n, n / 2, std::size_t{7}, std::size_t{1}}) {
    std::vector<Mesh> portions;
    std::vector<TriangleTree> trees;
    trees.reserve(step);
    for (std::size_t first = 0; first < step; ++first) {
      Mesh& portion = portions.emplace_back(Mesh{mesh.vertices, {}, {}});
      for (std::size_t t = first; t < n; t += step) portion.faces.push_back(mesh.faces[t]);
    }
    for (std::size_t first = 0; first < step; ++first) {
      trees.emplace_back(portions[first], frame, PortionNumbers{first, step});
    }
    for (int k = 0; k < 400; ++k) {
      Vec3 p = (k % 3 == 0 ? 0.1 : 1.0) * random_point(23, k);
      if (k % 5 == 0) p = {0.25 * (k % 7), 0.25 * (k % 11), 0.25 * (k % 13)};  // ties
      if (k == 399) p = {1e300, -1e20, 1e9};
      const ClosestPoint expected = whole.closest(p);
      for (const bool backwards : {false, true}) {
        ClosestSoFar found;
        for (std::size_t i = 0; i < step; ++i) {
          trees[backwards ? step - 1 - i : i].improve(p, kInfinity, found);
        }
        ASSERT_EQ(found.triangle, expected.triangle) << step << ' ' << k;
        ASSERT_EQ(found.distance, expected.distance) << step << ' ' << k;
      }
    }
  }
}

TEST(closest_point, of_a_degenerate_triangle_is_that_of_its_edges) {
  EXPECT_EQ(closest_point_of_triangle({0.3, 5, 0}, {{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}}),
            (Vec3{0.3, 0, 0}));
  EXPECT_EQ(closest_point_of_triangle({3, 4, 0}, {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}), Vec3{});
  EXPECT_EQ(closest_point_of_triangle({-1, 0, 0}, {{{0, 0, 0}, {2, 0, 0}, {2, 0, 0}}}), Vec3{});
}

// A needle of length 1 and width w: p at height h over its middle has the distance h for any w.
TEST(closest_point, of_a_sliver_is_as_good_as_its_normal) {
  for (const double width : {1e-2, 1e-6, 1e-10, 1e-14}) {
    const double h = 0.7;
    const Vec3 p = {0.5, width / 4, h};
    const Vec3 q = closest_point_of_triangle(p, {{{0, 0, 0}, {1, 0, 0}, {0.5, width, 0}}});
    EXPECT_NEAR(norm(p - q), h, 1e-15) << width;
  }
}

TEST(closest_point, of_a_mesh_without_triangles_or_to_nan_is_refused) {
  const Mesh none;
  EXPECT_THROW(TriangleTree(none).closest({0, 0, 0}), Error);
  const Mesh mesh = cube();
  EXPECT_THROW(TriangleTree(mesh).closest({std::nan(""), 0, 0}), Error);
}

TEST(closest_point, of_a_mesh_that_is_a_single_point_is_that_point) {
  Mesh mesh;
  mesh.vertices = {{1, 2, 3}};
  mesh.faces = {{0, 0, 0}};
  const ClosestPoint found = TriangleTree(mesh).closest({1, 2, 5});
  EXPECT_EQ(found.distance, 2);
  EXPECT_EQ(found.point, (Vec3{1, 2, 3}));
}

// Every number of triangles up to two levels of the tree and some more, so that leaves and nodes
// are full or partly filled.
TEST(closest_point, of_any_number_of_triangles_is_that_of_a_brute_force_search) {
  test::for_each_target([](const char* target) {
    for (std::uint32_t n = 1; n < 150; n += n < 20 ? 1 : 13) {
      const Mesh mesh = soup(n, n);
      const TriangleTree tree(mesh);
      for (int k = 0; k < 40; ++k) {
        const Vec3 p = random_point(12, k);
        ASSERT_NEAR(tree.closest(p).distance, brute_force_distance(mesh, p), 1e-14)
            << n << " triangles, " << target;
      }
    }
  });
}

// Returns the smallest distance to any triangle, in the tree's own frame and order of corners. A
// tree that skips no necessary triangle returns the same bits.
double distance_without_a_tree(const Mesh& mesh, const Vec3& p) {
  const UnitFrame frame = unit_frame(bounds(mesh.vertices));
  const Vec3 q = frame.to_local(p);
  double best = kInfinity;
  for (Triangle t : mesh.faces) {
    std::sort(t.begin(), t.end());
    const std::array<Vec3, 3> corners = {frame.to_local(mesh.vertices[t[0]]),
                                         frame.to_local(mesh.vertices[t[1]]),
                                         frame.to_local(mesh.vertices[t[2]])};
    best = std::min(best, norm(q - closest_point_of_triangle(q, corners)) / frame.scale);
  }
  return best;
}

// In single precision the planes of the tree hardly have a direction. Points lie on the triangles,
// near them, and far beyond their sharp corners.
TEST(closest_point, of_slivers_is_that_without_a_tree) {
  test::for_each_target([](const char* target) {
    for (const double width : {1e-3, 1e-5, 1e-7, 1e-9}) {
      Mesh mesh;
      for (std::uint32_t t = 0; t < 300; ++t) {
        const Vec3 a = random_point(20, t), b = a + 0.3 * random_point(21, t);
        const Vec3 c = a + random_uniform(22, t) * (b - a) + width * random_point(23, t);
        mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
        mesh.faces.push_back({3 * t, 3 * t + 1, 3 * t + 2});
      }
      const TriangleTree tree(mesh);
      for (std::uint32_t k = 0; k < 300; ++k) {
        const Triangle& t = mesh.faces[k];
        const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        const Vec3 inside = (a + b + c) / 3.0;
        for (const Vec3& p : {inside, inside + 1e-6 * random_point(24, k), b + 3.0 * (b - a)}) {
          ASSERT_EQ(tree.closest(p).distance, distance_without_a_tree(mesh, p))
              << width << ", " << target;
        }
      }
    }
  });
}

// Whole rows of triangles have the same middle coordinate.
TEST(closest_point, of_a_grid_is_the_height_over_it) {
  constexpr std::uint32_t kSide = 90;
  Mesh mesh;
  for (std::uint32_t i = 0; i <= kSide; ++i) {
    for (std::uint32_t j = 0; j <= kSide; ++j) mesh.vertices.push_back({1.0 * i, 1.0 * j, 0});
  }
  for (std::uint32_t i = 0; i < kSide; ++i) {
    for (std::uint32_t j = 0; j < kSide; ++j) {
      const std::uint32_t a = i * (kSide + 1) + j, b = a + kSide + 1;
      mesh.faces.push_back({a, b, a + 1});
      mesh.faces.push_back({b, b + 1, a + 1});
    }
  }
  const TriangleTree tree(mesh);
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const Vec3 p = {kSide * random_uniform(1, 3 * k), kSide * random_uniform(1, 3 * k + 1),
                    random_uniform(1, 3 * k + 2)};
    const ClosestPoint found = tree.closest(p);
    ASSERT_NEAR(found.distance, p.z, 1e-12);
    ASSERT_NEAR(norm(found.point - Vec3{p.x, p.y, 0}), 0, 1e-12);
  }
}

TEST(closest_point, is_the_same_alone_and_after_others) {
  const Mesh mesh = soup(9, 1000);
  const TriangleTree tree(mesh);
  std::vector<Vec3> points;
  for (int k = 0; k < 500; ++k) {
    points.push_back((k % 7 == 0 ? 1e-3 : 1.0) * random_point(13, k));
    if (k % 11 == 0) points.push_back(points.back());
    if (k % 100 == 50) points.push_back({1e308, -1e300, k * 1e20});
  }
  const std::vector<ClosestPoint> found = tree.closest(points);
  ASSERT_EQ(found.size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const ClosestPoint alone = tree.closest(points[k]);
    ASSERT_EQ(found[k].distance, alone.distance) << k;
    ASSERT_EQ(found[k].point, alone.point) << k;
    ASSERT_EQ(found[k].triangle, alone.triangle) << k;
  }
  EXPECT_TRUE(tree.closest(std::span<const Vec3>()).empty());
}

TEST(TriangleTree, of_several_threads_finds_what_that_of_one_does) {
  for (const std::uint32_t n : {1U, 9U, 65U, 600U, 30'000U}) {
    const Mesh mesh = soup(12, n);
    const TriangleTree one(mesh);
    for (const int threads : {2, 5}) {
      const TriangleTree several(mesh, {.threads = threads});
      for (int k = 0; k < 300; ++k) {
        const Vec3 p = 1.5 * random_point(8, k);
        const ClosestPoint found = several.closest(p), wanted = one.closest(p);
        ASSERT_EQ(found.triangle, wanted.triangle) << n;
        ASSERT_EQ(found.distance, wanted.distance) << n;
      }
    }
  }
}

TEST(TriangleTree, ends_where_the_scope_of_the_thread_says_so) {
  const Mesh mesh = soup(4, 40000);
  int asked = 0, go_on = 1 << 30;
  const CancelScope scope([&] { return ++asked < go_on; });
  { const TriangleTree tree(mesh); }
  for (const int at : {1, asked / 2, asked}) {
    go_on = at;
    asked = 0;
    EXPECT_THROW(TriangleTree{mesh}, Error) << at;
    EXPECT_EQ(asked, at);
  }
}

}  // namespace
}  // namespace rholm
