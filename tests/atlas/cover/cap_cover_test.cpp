// Covers of points with caps.
#include "atlas/cover/cap_cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "atlas/cap/cap_support.h"
#include "atlas/cover/cap_seed.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "support/test_points.h"

namespace rholm {
namespace {

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

// On a cap of support R_0 tan(15 degrees) a plane is r = R_0 / cos(theta). Degree 3 leaves at most
// its term 5 theta^4 / 24 as error; the error for a sphere as large as this one is smaller.
constexpr double kMissed = 0.0037;

std::span<const double> coefficients_of(const Cover& made, const Cap& cap) {
  return {made.coefficients.data() + cap.first, n_coefficients(cap.basis, cap.degree)};
}

TEST(CapCover, every_point_of_a_sphere_lies_within_a_cap_and_on_it) {
  const Ordered points = ordered(test::sphere_points(10000));
  const Cover made = cover(points.view(), {}, {});
  EXPECT_EQ(made.rejected.size(), 0U);
  std::vector<char> covered(10000, 0);
  double area = 0;
  for (const Cap& cap : made.caps) {
    EXPECT_LT(cap.error, kMissed * cap.frame.support);
    EXPECT_NEAR(norm(cap.frame.seed()), 1, 1e-12);
    EXPECT_GT(dot(cap.frame.z, cap.frame.seed()), 0.99);
    area += cap.area;
    std::vector<Neighbor> near;
    points.tree->within(cap.frame.seed(), cap.frame.support, near);
    for (const Neighbor& n : near) {
      const Vec3& p = points.points[n.index];
      if (place(cap, p - cap.frame.seed()) >= 1) continue;
      covered[n.index] = 1;
      EXPECT_NEAR(evaluate(cap, coefficients_of(made, cap), p).distance, 0,
                  2 * kMissed * cap.frame.support);
    }
  }
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), 10000);
  // Each point belongs to the area of one cap. Areas of discs with 24 random points scatter by a
  // fifth; their mean over hundreds of caps hardly scatters.
  EXPECT_NEAR(area, 4 * std::numbers::pi, 0.1 * 4 * std::numbers::pi);
}

TEST(CapCover, a_tolerance_makes_fewer_and_larger_caps_that_keep_it) {
  const Ordered points = ordered(test::sphere_points(10000));
  const std::size_t exact = cover(points.view(), {}, {}).caps.size();
  const Cover rough = cover(points.view(), {.tolerance = 1e-3}, {});
  EXPECT_LT(4 * rough.caps.size(), exact);
  for (const Cap& cap : rough.caps) EXPECT_LT(cap.error, 1e-3);
}

TEST(CapCover, caps_at_an_edge_fit_as_well_as_a_surface_must) {
  // A wedge with its edge along y: two planes that meet at right angles.
  PointCloud cloud;
  for (std::uint64_t i = 0; i < 8000; ++i) {
    const double a = test::random_in(0, 1, 1, i), y = test::random_in(0, 1, 2, i);
    const bool top = i % 2 == 0;
    cloud.points.push_back(top ? Vec3{a, y, 0} : Vec3{0, y, -a});
    cloud.normals.push_back(top ? Vec3{0, 0, 1} : Vec3{-1, 0, 0});
  }
  const Ordered points = ordered(cloud);
  const Cover made = cover(points.view(), {}, {});
  std::size_t n_edge = 0, n_away = 0;
  for (const Cap& cap : made.caps) {
    const Vec3 s = cap.frame.seed();
    const double from_edge = std::hypot(s.x, s.z);
    if (from_edge < cap.frame.support) {
      ++n_edge;
      EXPECT_LT(cap.error, 0.1 * cap.frame.support);
    } else {
      ++n_away;
      EXPECT_LT(cap.error, kMissed * cap.frame.support);
    }
  }
  EXPECT_GT(n_edge, 10U);
  EXPECT_GT(n_away, 100U);
}

TEST(CapCover, both_sides_of_a_plate_have_caps_of_their_own) {
  PointCloud plate;
  for (std::uint64_t i = 0; i < 8000; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    plate.points.push_back(
        {test::random_in(-1, 1, 3, i), test::random_in(-1, 1, 4, i), 0.01 * side});
    plate.normals.push_back({0, 0, side});
  }
  const Ordered points = ordered(plate);
  const Cover made = cover(points.view(), {}, {});
  EXPECT_LE(made.rejected.size(), 8U);  // at the border of both planes
  for (const Cap& cap : made.caps) {
    EXPECT_GT(cap.frame.seed().z * cap.frame.z.z, 0.009);
    // Points of the other side would give errors of the plate's thickness.
    EXPECT_LT(cap.error, 1e-4);
  }
}

// Returns random points of the strip -1/2 < x < 1/2, |y| < width / 2 in the plane z = 0.
PointCloud strip(double width, std::size_t n) {
  PointCloud cloud;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double x = test::random_in(-0.5, 0.5, 9, i), y = test::random_in(-0.5, 0.5, 10, i);
    cloud.points.push_back({x, width * y, 0});
    cloud.normals.push_back({0, 0, 1});
  }
  return cloud;
}

TEST(CapCover, caps_of_a_strip_have_no_weight_beside_it) {
  // The strip is one point wide. The 24 nearest points reach 12 widths to either side, where the
  // thinnest ellipse reaches 12 sqrt(0.1) = 3.8 widths from the middle. The 9 nearest points reach
  // 4.5 widths, and the ellipse 1.4 widths.
  constexpr double kWidth = 0.004;
  constexpr std::size_t kPoints = 250;
  const Ordered points = ordered(strip(kWidth, kPoints));
  const Cover made = cover(points.view(), {}, {});
  ASSERT_GT(made.caps.size(), 20U);
  for (const Cap& cap : made.caps) {
    for (int i = -500; i <= 500; ++i) {
      for (const double y : {-3 * kWidth, 3 * kWidth}) {
        EXPECT_GT(place(cap, Vec3{0.001 * i, y, 0} - cap.frame.seed()), 1);
      }
    }
  }
}

// Returns points of the faces of a box of 2 x 1 x `thickness`, distributed by area.
PointCloud box_points(double thickness, std::size_t n) {
  return sample_surface(box({2, 1, thickness}), {.points = n, .seed = 1});
}

TEST(CapCover, caps_of_both_sides_of_a_plate_have_all_the_points_they_are_to_have) {
  // The sheets are much nearer than the points: half of the nearest points lie on the other sheet.
  const Ordered points = ordered(box_points(0.001, 8000));
  const Cover made = cover(points.view(), {}, {});
  const double wanted = std::sqrt(24 * 4.0 / 8000 / std::numbers::pi);  // 24 points of one sheet
  double sum = 0;
  std::size_t n = 0;
  for (const Cap& cap : made.caps) {
    const Vec3 s = cap.frame.seed();
    if (std::abs(s.x) > 1 - 2 * wanted || std::abs(s.y) > 0.5 - 2 * wanted) continue;
    EXPECT_GT(s.z * cap.frame.z.z, 0);
    sum += cap.frame.support;
    ++n;
  }
  ASSERT_GT(n, 500U);
  EXPECT_NEAR(sum / static_cast<double>(n), wanted, 0.05 * wanted);
}

// A plate with one point lifted off its upper side.
TEST(CapCover, a_noisy_seed_settles_on_the_mean_of_the_points_around_it) {
  constexpr double kLifted = 0.02, kThickness = 0.03;
  PointCloud plate;
  for (std::uint64_t i = 0; i < 8000; ++i) {
    const bool top = i % 2 == 0;
    plate.points.push_back(
        {test::random_in(-1, 1, 11, i), test::random_in(-1, 1, 12, i), top ? 0.0 : -kThickness});
    plate.normals.push_back({0, 0, top ? 1.0 : -1.0});
  }
  plate.points.push_back({0, 0, kLifted});
  plate.normals.push_back({0, 0, 1});
  const Ordered points = ordered(plate);
  const auto lifted = std::find_if(points.points.begin(), points.points.end(),
                                   [](const Vec3& p) { return p.z > 0; });
  const auto seed = static_cast<std::size_t>(lifted - points.points.begin());
  CapWorker worker;
  worker.middle = *lifted;
  points.tree->nearest_to(seed, 60, worker.near);
  std::size_t n = 0;  // points of the upper side among the nearest quarter, with the seed
  for (std::size_t j = 0; j < 15; ++j) n += points.normals[worker.near[j].index].z > 0;
  ASSERT_GT(n, 4U);
  settle(points.view(), seed, worker);
  EXPECT_NEAR(norm(worker.middle - Vec3{0, 0, kLifted / static_cast<double>(n)}), 0, 1e-12);
  for (std::size_t j = 0; j < worker.near.size(); ++j) {
    const Vec3 offset = points.points[worker.near[j].index] - worker.middle;
    const double d2 = dot(offset, offset);
    EXPECT_NEAR(worker.near[j].distance2, d2, 1e-6 * d2);
    EXPECT_GE(worker.near[j].distance2, worker.near[j == 0 ? 0 : j - 1].distance2);
  }
}

TEST(CapCover, a_noisy_cap_counts_by_the_square_of_its_points) {
  // In the plane all caps use the 60 points that they are given. Caps across the right angle
  // between two planes fit worse than the noise, so that they are made smaller.
  PointCloud cloud;
  for (std::uint64_t i = 0; i < 8000; ++i) {
    const double a = test::random_in(0, 1, 13, i), y = test::random_in(0, 1, 14, i);
    const double noise = 0.003 * test::random_normal(15, i);
    const bool top = i % 2 == 0;
    cloud.points.push_back(top ? Vec3{a, y, noise} : Vec3{noise, y, -a});
    cloud.normals.push_back(top ? Vec3{0, 0, 1} : Vec3{-1, 0, 0});
  }
  const Ordered points = ordered(cloud);
  const Cover made = cover(points.view(), {.neighbours = 60, .noise = 0.003}, {});
  std::size_t whole = 0, small = 0;
  for (const Cap& cap : made.caps) {
    // Caps whose residuals exceed the noise have a smaller weight in addition.
    if (cap.error > 0.003) continue;
    // A cap has 60, 39, 25, ... points minus the points that face away: here there are none.
    const double n = 60 * std::sqrt(cap.weight);
    EXPECT_NEAR(n, std::round(n), 1e-9);
    const double nearest = std::min(
        {std::abs(n - 60), std::abs(n - 39), std::abs(n - 25), std::abs(n - 16), std::abs(n - 10)});
    EXPECT_NEAR(nearest, 0, 1e-9);
    (n > 59 ? whole : small) += 1;
  }
  EXPECT_GT(whole, 100U);
  EXPECT_GT(small, 10U);
}

TEST(CapCover, points_without_a_surface_are_rejected) {
  PointCloud cloud;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    cloud.points.push_back(
        {test::random_in(-1, 1, 5, i), test::random_in(-1, 1, 6, i), test::random_in(-1, 1, 7, i)});
    cloud.normals.push_back(test::random_direction(8, i));
  }
  const Ordered points = ordered(cloud);
  const Cover made = cover(points.view(), {}, {});
  EXPECT_GT(made.rejected.size(), 1000U);
}

TEST(CapCover, is_the_same_for_every_number_of_threads) {
  const Ordered points = ordered(test::sphere_points(10000));
  const Cover one = cover(points.view(), {}, {.threads = 1});
  const Cover two = cover(points.view(), {}, {.threads = 2});
  EXPECT_EQ(one.coefficients, two.coefficients);
  EXPECT_EQ(one.caps.size(), two.caps.size());
}

}  // namespace
}  // namespace rholm
