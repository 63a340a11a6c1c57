#include "shape/points/sampling_gaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "rholm/points.h"
#include "rholm/primitives.h"
#include "support/sizes.h"
#include "support/test_points.h"

namespace rholm {
namespace {

using Cloud = test::OrderedCloud;

std::vector<Vec3> plane_grid(double along, double across, int n) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j * across < n * along; ++j) points.push_back({i * along, j * across, 0});
  }
  return points;
}

TEST(sampling_gaps, of_a_grid_have_the_ratio_of_its_steps) {
  for (const double ratio : {2.0, 5.0, 20.0}) {
    const Cloud cloud(plane_grid(1, ratio, 200));
    const SamplingGaps gaps = find_gaps(cloud.tree, cloud.points, {}, {});
    ASSERT_EQ(gaps.ratio.size(), cloud.points.size());
    std::vector<float> sorted = gaps.ratio;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_NEAR(sorted[sorted.size() / 2], ratio, 0.05 * ratio);
    EXPECT_EQ(gaps.scaled(0, 10), static_cast<std::size_t>(10.0 * gaps.ratio[0] + 0.5));
  }
}

TEST(sampling_gaps, are_none_of_even_or_random_points) {
  const Cloud even(plane_grid(1, 1, 60));
  EXPECT_TRUE(find_gaps(even.tree, even.points, {}, {}).ratio.empty());
  for (const double density_ratio : {1.0, 30.0}) {
    const Cloud random(
        sample_surface(torus(2, 0.7, 200, 100), {.points = 5000, .density_ratio = density_ratio})
            .points);
    const SamplingGaps gaps = find_gaps(random.tree, random.points, {}, {});
    EXPECT_TRUE(gaps.ratio.empty());
    EXPECT_EQ(gaps.of(7), 1);
    EXPECT_EQ(gaps.scaled(7, 24), 24u);
  }
}

TEST_OF_TWO_SIZES(sampling_gaps, of_slices_and_rings_have_their_ratio_wherever_they_are) {
  const Mesh ring = torus(2, 0.7, 400, 200);
  for (const double ratio : nightly ? std::vector{5.0, 20.0} : std::vector{5.0}) {
    const Cloud cloud(
        sample_surface(ring,
                       {.points = 30000, .pattern = SamplePattern::kRings, .pattern_ratio = ratio})
            .points);
    const SamplingGaps gaps = find_gaps(cloud.tree, cloud.points, {}, {});
    ASSERT_EQ(gaps.ratio.size(), cloud.points.size());
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      // The distance of rows is proportional to the distance from the axis.
      const Vec3& p = cloud.points[i];
      const double here = ratio * std::hypot(p.x, p.y) / 2;
      EXPECT_GT(gaps.ratio[i], 0.6 * here);
      EXPECT_LT(gaps.ratio[i], std::min(kMostGapRatio + 1, 1.7 * here));
    }
  }
}

// Returns rings on the unit sphere with equal steps between rings.
std::vector<Vec3> sphere_of_rings(int n_rings, double ratio) {
  std::vector<Vec3> points;
  const double across = std::numbers::pi / n_rings;
  for (int ring = 1; ring < n_rings; ++ring) {
    const double theta = ring * across, radius = std::sin(theta);
    const int n = static_cast<int>(2 * std::numbers::pi * radius * ratio / across);
    for (int i = 0; i < n; ++i) {
      const double phi = 2 * std::numbers::pi * (i + 0.37 * ring) / n;
      points.push_back({radius * std::cos(phi), radius * std::sin(phi), std::cos(theta)});
    }
  }
  return points;
}

TEST(sampling_gaps, of_small_rings_around_a_pole_have_the_ratio_of_all) {
  for (const double ratio : {5.0, 20.0}) {
    const Cloud cloud(sphere_of_rings(40, ratio));
    const SamplingGaps gaps =
        find_gaps(cloud.tree, cloud.points, cloud.points, {}, RowsThatTurn::kCount);
    ASSERT_EQ(gaps.ratio.size(), cloud.points.size());
    for (const float found : gaps.ratio) EXPECT_NEAR(found, ratio, 0.3 * ratio);
  }
}

TEST(sampling_gaps, of_a_sheet_do_not_reach_another_as_near_as_the_next_row) {
  for (const double ratio : {5.0, 20.0}) {
    PointCloud sheets;
    for (const double side : {-1.0, 1.0}) {
      for (const Vec3& p : plane_grid(1, ratio, 200)) {
        sheets.points.push_back({p.x, p.y, side * 0.4 * ratio});
        sheets.normals.push_back({0, 0, side});
      }
    }
    const Cloud cloud(sheets);
    const SamplingGaps gaps = find_gaps(cloud.tree, cloud.points, cloud.normals, {});
    ASSERT_EQ(gaps.ratio.size(), cloud.points.size());
    std::vector<float> sorted = gaps.ratio;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_NEAR(sorted[sorted.size() / 2], ratio, 0.05 * ratio);
  }
}

TEST(sampling_gaps, are_the_same_for_any_number_of_threads) {
  const Cloud cloud(plane_grid(1, 7, 150));
  EXPECT_EQ(find_gaps(cloud.tree, cloud.points, {}, {.threads = 1}).ratio,
            find_gaps(cloud.tree, cloud.points, {}, {.threads = 4}).ratio);
}

TEST(sampling_gaps, of_few_or_degenerate_points_are_finite) {
  for (const std::size_t n : {1u, 2u, 3u, 5u, 30u}) {
    std::vector<Vec3> line;
    line.reserve(n);
    for (std::size_t i = 0; i < n; ++i) line.push_back({static_cast<double>(i), 0, 0});
    const Cloud cloud(line);
    for (const double ratio : gap_ratios(cloud.tree, cloud.points, {}, 100, {})) {
      EXPECT_GE(ratio, 1);
      EXPECT_LE(ratio, kMostGapRatio);
    }
  }
}

}  // namespace
}  // namespace rholm
