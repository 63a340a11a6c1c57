// Oracles are the direct sum and the closed forms of a sphere and of a disc.
#include "shape/queries/winding_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "base/random.h"
#include "rholm/error.h"
#include "support/targets.h"

namespace rholm {
namespace {

using std::numbers::pi;

struct Sheet {
  std::vector<Vec3> points, area_normals;
};

// Returns n points of a sphere along a spiral; each has the area 4 pi / n.
Sheet sphere(int n) {
  Sheet sheet;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n;
    const double phi = i * pi * (3 - std::sqrt(5.0));
    const double s = std::sqrt(1 - z * z);
    sheet.points.push_back({s * std::cos(phi), s * std::sin(phi), z});
    sheet.area_normals.push_back(4 * pi / n * sheet.points.back());
  }
  return sheet;
}

std::vector<Vec3> random_points(std::size_t n, std::uint64_t seed, double half_side) {
  std::vector<Vec3> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto u = [&](std::uint64_t k) {
      return half_side * (2 * random_uniform(seed, 3 * i + k) - 1);
    };
    points[i] = {u(0), u(1), u(2)};
  }
  return points;
}

double direct_sum(const Sheet& sheet, const Vec3& x) {
  double sum = 0;
  for (std::size_t j = 0; j < sheet.points.size(); ++j) {
    const Vec3 r = sheet.points[j] - x;
    const double radius = std::sqrt(norm(sheet.area_normals[j]) / pi);
    sum += dot(sheet.area_normals[j], r) / std::pow(std::max(norm(r), radius), 3);
  }
  return sum / (4 * pi);
}

double largest_error(const Sheet& sheet, std::span<const Vec3> x, double opening) {
  const WindingTree tree(sheet.points, sheet.area_normals);
  const std::vector<double> w = tree.winding(x, {}, opening);
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    largest = std::max(largest, std::abs(w[i] - direct_sum(sheet, x[i])));
  }
  return largest;
}

TEST(WindingTree, is_the_direct_sum_and_converges_to_it_with_the_opening) {
  Sheet sheet = sphere(3000);
  for (std::size_t i = 0; i < sheet.points.size(); ++i) {  // an uneven shape with unrelated normals
    sheet.points[i] = (1 + random_uniform(1, i)) * sheet.points[i];
  }
  const std::vector<Vec3> x = random_points(500, 2, 2.5);
  // The omitted terms are about (radius / distance)^2 of the kept terms, and fall with them: see
  // below.
  EXPECT_LT(largest_error(sheet, x, 2), 0.03);
  EXPECT_LT(largest_error(sheet, x, 6), 0.003);
  EXPECT_LT(largest_error(sheet, x, 1e6), 1e-12);
}

TEST(WindingTree, sphere_has_1_inside_and_0_outside) {
  const Sheet sheet = sphere(20000);
  const WindingTree tree(sheet.points, sheet.area_normals);
  std::vector<Vec3> x = random_points(2000, 3, 1.3);
  const double spacing = std::sqrt(4 * pi / 20000);
  // The error of the far field falls with the third power of the opening (measured).
  for (const auto& [opening, tolerance] : {std::pair{2.0, 0.01}, {4.0, 0.001}}) {
    const std::vector<double> w = tree.winding(x, {}, opening);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double r = norm(x[i]);
      // Within a spacing or two of the points their pattern is visible.
      if (std::abs(r - 1) > 2 * spacing) {
        EXPECT_NEAR(w[i], r < 1 ? 1 : 0, tolerance) << r;
      }
    }
  }
}

// From height h over the middle of a disc of radius 1, w is (1 - h / sqrt(1 + h^2)) / 2.
TEST(WindingTree, open_disc_has_half_of_its_solid_angle_over_2_pi) {
  Sheet sheet;
  const int rings = 100;
  for (int i = 0; i < rings; ++i) {
    const double r = (i + 0.5) / rings;
    const int n = 6 * i + 3;
    for (int j = 0; j < n; ++j) {
      const double phi = 2 * pi * j / n;
      sheet.points.push_back({r * std::cos(phi), r * std::sin(phi), 0});
      sheet.area_normals.push_back({0, 0, 2 * pi * r / rings / n});
    }
  }
  const WindingTree tree(sheet.points, sheet.area_normals);
  for (const double h : {0.05, 0.3, 1.0, 5.0}) {
    const std::vector<Vec3> x = {{0, 0, -h}, {0, 0, h}};
    const std::vector<double> w = tree.winding(x, {}, 6);
    const double expected = (1 - h / std::sqrt(1 + h * h)) / 2;
    EXPECT_NEAR(w[0], expected, 2e-3);
    EXPECT_NEAR(w[1], -expected, 2e-3);
  }
}

TEST(WindingTree, passes_through_one_half_smoothly_at_the_points) {
  const Sheet sheet = sphere(5000);
  const WindingTree tree(sheet.points, sheet.area_normals);
  const std::vector<double> w = tree.winding(sheet.points);
  for (const double at_point : w) EXPECT_NEAR(at_point, 0.5, 0.03);
}

TEST(WindingTree, other_normals_are_taken_over) {
  Sheet sheet = sphere(1000);
  WindingTree tree(sheet.points, sheet.area_normals);
  for (Vec3& a : sheet.area_normals) a = -2 * a;
  tree.set_area_normals(sheet.area_normals);
  const std::vector<Vec3> x = random_points(100, 4, 2);
  EXPECT_EQ(tree.winding(x), WindingTree(sheet.points, sheet.area_normals).winding(x));
}

TEST(WindingTree, scale_and_place_do_not_matter) {
  const Sheet sheet = sphere(1000);
  const std::vector<Vec3> x = random_points(100, 5, 2);
  const std::vector<double> w = WindingTree(sheet.points, sheet.area_normals).winding(x);
  for (const double scale : {1e-100, 1e-6, 1e6, 1e100}) {
    Sheet other = sheet;
    std::vector<Vec3> y = x;
    const Vec3 shift = scale * Vec3{1000, 2000, -3000};
    for (Vec3& p : other.points) p = scale * p + shift;
    for (Vec3& a : other.area_normals) a = scale * (scale * a);
    for (Vec3& p : y) p = scale * p + shift;
    const std::vector<double> moved = WindingTree(other.points, other.area_normals).winding(y);
    for (std::size_t i = 0; i < w.size(); ++i) EXPECT_NEAR(moved[i], w[i], 1e-8);
  }
}

TEST(WindingTree, threads_do_not_change_a_bit) {
  const Sheet sheet = sphere(5000);
  const WindingTree tree(sheet.points, sheet.area_normals);
  const std::vector<Vec3> x = random_points(5000, 6, 2);
  EXPECT_EQ(tree.winding(x, {.threads = 1, .progress = {}}),
            tree.winding(x, {.threads = 2, .progress = {}}));
}

TEST(WindingTree, other_queries_do_not_change_a_bit) {
  const Sheet sheet = sphere(5000);
  const WindingTree tree(sheet.points, sheet.area_normals);
  const std::vector<Vec3> x = random_points(500, 7, 2);
  const std::vector<double> all = tree.winding(x);
  for (std::size_t i = 0; i < x.size(); i += 7) {
    EXPECT_EQ(tree.winding(std::span(x).subspan(i, 1))[0], all[i]);
  }
}

TEST(WindingTree, any_number_of_queries_has_the_direct_sums) {
  const Sheet sheet = sphere(60);
  const WindingTree tree(sheet.points, sheet.area_normals);
  const std::vector<Vec3> x = random_points(33, 8, 2);
  test::for_each_target([&](const char* target) {
    for (std::size_t n = 1; n <= x.size(); ++n) {
      const std::vector<double> w = tree.winding(std::span(x).first(n), {}, 1e6);
      ASSERT_EQ(w.size(), n);
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_NEAR(w[i], direct_sum(sheet, x[i]), 1e-12) << target << " " << n;
      }
      EXPECT_EQ(w[n - 1], tree.winding(std::span(x).subspan(n - 1, 1), {}, 1e6)[0]) << target;
    }
  });
}

TEST(WindingTree, degenerate_points_give_finite_numbers) {
  EXPECT_EQ(WindingTree({}, {}).winding(std::vector<Vec3>{{1, 2, 3}}), std::vector<double>{0});
  const std::vector<Vec3> same(100, Vec3{1, 1, 1});
  for (const Vec3& a : {Vec3{}, Vec3{0, 0, 1}}) {
    const std::vector<double> w =
        WindingTree(same, std::vector<Vec3>(100, a)).winding(std::vector<Vec3>{{1, 1, 1}});
    EXPECT_EQ(w[0], 0);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> bad = {{0, nan, 0}};
  const std::vector<Vec3> good = {{0, 0, 1}};
  EXPECT_THROW(WindingTree(bad, good), Error);
  EXPECT_THROW(WindingTree(good, bad), Error);
  EXPECT_THROW(WindingTree(good, same), Error);
}

// The first levels alone give the same bits where no other level is needed, which is nearly
// everywhere.
TEST(winding_tree, has_the_same_numbers_by_its_first_levels) {
  const Sheet sheet = sphere(5000);
  const WindingTree tree(sheet.points, sheet.area_normals);
  const std::vector<Vec3> x = random_points(2001, 3, 4);
  const std::vector<double> whole = tree.winding(x);
  std::size_t n_before = 0;
  for (const int levels : {0, 1, 2, 4}) {
    const WindingTree top = tree.top(levels);
    const std::vector<double> found = top.winding(x);
    std::size_t n = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!top.has_all(x[i], kWindingOpening)) continue;
      EXPECT_EQ(found[i], whole[i]);
      ++n;
    }
    EXPECT_GT(n, n_before);
    n_before = n;
    EXPECT_FALSE(top.has_all(sheet.points[7], kWindingOpening));
  }
  EXPECT_GT(n_before, x.size() * 9 / 10);
  EXPECT_TRUE(WindingTree({}, {}).top(2).has_all({}, kWindingOpening));
}

}  // namespace
}  // namespace rholm
