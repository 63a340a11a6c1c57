// Star-shaped patches and their spheres.
#include "paper/patches/kd_partition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "support/random_data.h"
#include "support/test_points.h"

namespace rholm {
namespace {

PointCloud torus_points(std::size_t n) {
  return sample_surface(torus(2, 0.7, 64, 32), {.points = n});
}

// Returns points within `half_angle` of the z axis, on the sphere about `center`.
PointCloud cap_points(std::size_t n, double half_angle, const Vec3& center, double radius) {
  PointCloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = test::random_in(std::cos(half_angle), 1, 3, 2 * i);
    const double phi = test::random_in(0, 2 * std::numbers::pi, 3, 2 * i + 1);
    const double s = std::sqrt(1 - z * z);
    cloud.normals.push_back({s * std::cos(phi), s * std::sin(phi), z});
    cloud.points.push_back(center + radius * cloud.normals.back());
  }
  return cloud;
}

TEST(SphereFit, points_of_a_sphere_give_it_back) {
  const Vec3 center = {0.3, -0.7, 1.1};
  for (const double half_angle : {0.3, 1.0, 3.0}) {
    const PointCloud cloud = cap_points(50, half_angle, center, 0.8);
    const auto sphere = fit_sphere(cloud.points);
    ASSERT_TRUE(sphere);
    // A cap of height h = R (1 - cos) determines the centre to about eps (R / h)^2.
    const double slack = 1e-14 / std::pow(1 - std::cos(half_angle), 2);
    EXPECT_NEAR(norm(sphere->center - center), 0, slack);
    EXPECT_NEAR(sphere->radius, 0.8, slack);
  }
}

// With heights h over a plane of symmetric points, c_z = sum h q^2 / 2 sum h^2 in centred
// coordinates. Two rings of four points have the radii 1 and 2 at h = 1 and -1: sum h (q^2 - mean)
// is 4 (1 + 1) - 4 (4 + 1) = -12, so c_z = -12 / (2 * 8) = -3/4, and r^2 = 9/16 + 7/2.
TEST(SphereFit, is_the_least_squares_of_the_papers_equations) {
  std::vector<Vec3> points;
  for (const double h : {1.0, -1.0}) {
    const double r = h > 0 ? 1 : 2;
    for (const Vec3& p : {Vec3{r, 0, h}, Vec3{-r, 0, h}, Vec3{0, r, h}, Vec3{0, -r, h}}) {
      points.push_back(p + Vec3{5, 6, 7});
    }
  }
  const auto sphere = fit_sphere(points);
  ASSERT_TRUE(sphere);
  EXPECT_NEAR(norm(sphere->center - Vec3{5, 6, 7 - 0.75}), 0, 1e-14);
  EXPECT_NEAR(sphere->radius, std::sqrt(9.0 / 16 + 3.5), 1e-14);
}

TEST(SphereFit, points_without_a_sphere_have_none) {
  EXPECT_FALSE(fit_sphere({}));
  const std::vector<Vec3> same(9, {1, 2, 3});
  EXPECT_FALSE(fit_sphere(same));
  std::vector<Vec3> plane;
  for (std::uint64_t i = 0; i < 30; ++i) {
    const double s = test::random_in(-1, 1, 1, i), t = test::random_in(-1, 1, 2, i);
    plane.push_back({s, t, 0.3 * s - 0.4 * t});
  }
  EXPECT_FALSE(fit_sphere(plane));
  EXPECT_FALSE(fit_sphere(std::span(plane).first(3)));
}

TEST(SphereFit, a_large_cap_has_its_own_sphere_and_flat_or_hollow_patches_a_centre_below) {
  const PointCloud dome = cap_points(200, 1, {1, 2, 3}, 0.5);
  const PatchSphere best = patch_sphere({dome.points, dome.normals}, 0.1);
  EXPECT_TRUE(best.best_fitting);
  EXPECT_NEAR(best.star_cosine, 1, 1e-12);
  EXPECT_NEAR(norm(best.sphere.center - Vec3{1, 2, 3}), 0, 1e-12);

  PointCloud hollow = dome;
  for (Vec3& n : hollow.normals) n = -n;
  PointCloud flat = cap_points(200, 0.05, {0, 0, 0}, 1);
  for (const PointCloud& cloud : {hollow, flat}) {
    const PatchSphere below = patch_sphere({cloud.points, cloud.normals}, 0.1);
    EXPECT_FALSE(below.best_fitting);
    const Vec3 up = mean_normal(cloud.normals);
    EXPECT_GT(dot(up, below.axis), 0.99);
    EXPECT_GT(below.star_cosine, 0.1);
  }
  const std::vector<Vec3> one = {{1, 2, 3}}, up = {{0, 0, 1}};
  EXPECT_EQ(patch_sphere({one, up}, 0.1).star_cosine, 1);
}

TEST(KdPartition, every_point_is_in_one_patch_and_every_patch_holds) {
  const PointCloud cloud = torus_points(20000);
  const PartitionOptions options{.min_cosine = 0.7, .star = 0.2};
  const KdPartition made = kd_partition(cloud.points, cloud.normals, options);
  EXPECT_EQ(made.n_failed, 0U);
  std::vector<int> times(20000, 0);
  for (const std::uint32_t i : made.order) ++times[i];
  for (const int n : times) ASSERT_EQ(n, 1);
  std::uint32_t next = 0;
  for (const KdPatch& patch : made.patches) {
    ASSERT_EQ(patch.begin, next);
    next = patch.end;
    ASSERT_GE(patch.end - patch.begin, options.min_points);
    Vec3 mean;
    for (std::uint32_t k = patch.begin; k < patch.end; ++k) mean += cloud.normals[made.order[k]];
    for (std::uint32_t k = patch.begin; k < patch.end; ++k) {
      const Vec3& n = cloud.normals[made.order[k]];
      const Vec3 ray = cloud.points[made.order[k]] - patch.seen.sphere.center;
      ASSERT_GT(dot(n, normalized(mean)), options.min_cosine - 1e-12);
      ASSERT_GT(dot(n, normalized(ray)), options.star - 1e-12);
    }
  }
  EXPECT_EQ(next, 20000U);
}

TEST(KdPartition, a_convex_cap_within_the_cone_stays_whole) {
  const PointCloud cloud = cap_points(500, 0.9, {1, 2, 3}, 4);
  const KdPartition made = kd_partition(cloud.points, cloud.normals, {.min_cosine = 0.5});
  ASSERT_EQ(made.patches.size(), 1U);
  EXPECT_NEAR(made.patches[0].seen.sphere.radius, 4, 1e-10);
  EXPECT_NEAR(norm(made.patches[0].seen.sphere.center - Vec3{1, 2, 3}), 0, 1e-10);
}

// A roof whose sides slope down by 70 degrees. Its normals lie within a cone of 70 degrees, but a
// centre that sees the whole roof sees its sides nearly edge-on.
TEST(KdPartition, a_patch_within_the_cone_is_split_where_it_is_not_star_shaped) {
  const double slope = 70 * std::numbers::pi / 180;
  PointCloud roof;
  for (std::uint64_t i = 0; i < 600; ++i) {
    const double x = test::random_in(-1, 1, 1, i), side = x < 0 ? -1 : 1;
    roof.points.push_back({x, test::random_in(-1, 1, 2, i), -std::tan(slope) * std::abs(x)});
    roof.normals.push_back({side * std::sin(slope), 0, std::cos(slope)});
  }
  const auto patches = [&](double star) {
    return kd_partition(roof.points, roof.normals, {.min_cosine = 0.2, .star = star}).patches;
  };
  EXPECT_EQ(patches(0.05).size(), 1U);
  const std::vector<KdPatch> split = patches(0.8);
  EXPECT_GT(split.size(), 1U);
  for (const KdPatch& patch : split) {
    if (patch.holds) {
      EXPECT_GT(patch.seen.star_cosine, 0.8);
    }
  }
}

// Two coincident sheets of opposite normals cannot be separated: every half contains both.
TEST(KdPartition, folds_finer_than_the_points_are_reported) {
  PointCloud cloud;
  for (std::uint64_t i = 0; i < 400; ++i) {
    cloud.points.push_back({test::random_in(0, 1, 1, i), test::random_in(0, 1, 2, i), 0});
    cloud.normals.push_back({0, 0, i % 2 == 0 ? 1.0 : -1.0});
  }
  const KdPartition made = kd_partition(cloud.points, cloud.normals, {.min_points = 8});
  EXPECT_GT(made.n_failed, made.patches.size() / 2);
  for (const KdPatch& patch : made.patches) {
    EXPECT_GE(patch.end - patch.begin, 8U);
    EXPECT_LT(patch.end - patch.begin, 17U);
  }
  const PointCloud same{.points = std::vector<Vec3>(100, {1, 1, 1}),
                        .normals = std::vector<Vec3>(100, {0, 0, 1}),
                        .attributes = {}};
  EXPECT_EQ(kd_partition(same.points, same.normals).order.size(), 100U);
}

TEST(KdPartition, scale_and_place_and_threads_do_not_matter) {
  const PointCloud cloud = torus_points(5000);
  const KdPartition made = kd_partition(cloud.points, cloud.normals, {}, {.threads = 1});
  const KdPartition again = kd_partition(cloud.points, cloud.normals, {}, {.threads = 2});
  ASSERT_EQ(made.order, again.order);
  for (const double scale : {0x1p-900, 0x1p900}) {
    PointCloud scaled = cloud;
    for (Vec3& p : scaled.points) p *= scale;
    for (Vec3& n : scaled.normals) n *= scale;
    const KdPartition other = kd_partition(scaled.points, scaled.normals);
    ASSERT_EQ(other.order, made.order);
    ASSERT_EQ(other.patches.size(), made.patches.size());
    for (std::size_t i = 0; i < made.patches.size(); ++i) {
      EXPECT_EQ(again.patches[i].seen.sphere.center, made.patches[i].seen.sphere.center);
      EXPECT_NEAR(other.patches[i].seen.sphere.radius / scale, made.patches[i].seen.sphere.radius,
                  1e-9 * made.patches[i].seen.sphere.radius);
    }
  }
}

TEST(KdPartition, refuses_what_it_cannot_use) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}}, up(2, {0, 0, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> bad = {{0, 0, 0}, {1, nan, 0}}, zero(2);
  EXPECT_THROW(kd_partition(bad, up), Error);
  EXPECT_THROW(kd_partition(points, bad), Error);
  EXPECT_THROW(kd_partition(points, zero), Error);
  EXPECT_THROW(kd_partition(points, std::span(up).first(1)), Error);
  EXPECT_THROW(kd_partition(points, up, {.min_cosine = 1.5}), Error);
  EXPECT_THROW(kd_partition(points, up, {.star = nan}), Error);
  EXPECT_THROW(kd_partition(points, up, {.min_points = 0}), Error);
  EXPECT_TRUE(kd_partition({}, {}).patches.empty());
}

}  // namespace
}  // namespace rholm
