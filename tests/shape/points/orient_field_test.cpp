// Normals from the field of all points, without any known normal.
#include "shape/points/orient_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "rholm/points.h"
#include "rholm/primitives.h"
#include "support/test_points.h"

namespace rholm {
namespace {

using std::numbers::pi;

// A cloud in the order of its tree, within -1 ... 1, with the area per point.
struct Scene : test::OrderedCloud {
  Scene(const PointCloud& cloud, double area) : OrderedCloud(cloud) {
    spacing.assign(points.size(), std::sqrt(area / static_cast<double>(points.size())));
  }
  double share_right() const {
    const std::vector<Vec3> found = field_normals(tree, points, spacing, 0.5, {});
    double right = 0;
    for (std::size_t i = 0; i < found.size(); ++i) right += dot(found[i], normals[i]) > 0;
    return right / static_cast<double>(found.size());
  }
  std::vector<double> spacing;
};

PointCloud scaled(PointCloud cloud, double factor, double sign = 1) {
  for (Vec3& p : cloud.points) p *= factor;
  for (Vec3& n : cloud.normals) n = sign * n;
  return cloud;
}

TEST(field_normals, of_a_sphere_point_outwards_all) {
  EXPECT_EQ(Scene(test::sphere_points(800), 4 * pi).share_right(), 1);
}

TEST(field_normals, of_a_shell_as_thin_as_its_points_are_apart_have_both_sides) {
  // 1000 points with the spacing 0.147; the sheets are 0.15 apart.
  const double inner = 0.85;
  const PointCloud shell =
      test::joined(test::sphere_points(580, 1), scaled(test::sphere_points(420, 2), inner, -1));
  EXPECT_EQ(Scene(shell, 4 * pi * (1 + inner * inner)).share_right(), 1);
}

TEST(field_normals, of_points_in_rows_are_those_of_the_surface) {
  const PointCloud rows = scaled(
      sample_surface(torus(2, 0.7, 200, 100),
                     {.points = 12000, .pattern = SamplePattern::kRings, .pattern_ratio = 12}),
      1 / 2.7);
  // The spacing is the distance of rows: the area per point is a twelfth of its square.
  EXPECT_EQ(Scene(rows, 12 * 4 * pi * pi * 2 * 0.7 / (2.7 * 2.7)).share_right(), 1);
}

TEST(field_normals, of_more_points_than_the_first_sample_holds_begin_with_it) {
  EXPECT_EQ(Scene(test::sphere_points(9000), 4 * pi).share_right(), 1);
}

TEST(field_normals, are_the_same_for_any_number_of_threads) {
  const Scene scene(test::sphere_points(1500), 4 * pi);
  EXPECT_EQ(field_normals(scene.tree, scene.points, scene.spacing, 0.5, {.threads = 1}),
            field_normals(scene.tree, scene.points, scene.spacing, 0.5, {.threads = 3}));
}

TEST(field_normals, of_few_points_are_finite) {
  for (const std::size_t n : {1u, 2u, 3u, 9u, 16u, 17u}) {
    const Scene scene(test::sphere_points(n), 4 * pi);
    for (const Vec3& v : field_normals(scene.tree, scene.points, scene.spacing, 0.5, {})) {
      EXPECT_TRUE(is_finite(v)) << n;
    }
  }
}

TEST(field_normals, of_points_at_nearly_one_place_are_found_and_finite) {
  // There are more points than the first sample holds. In single precision, none of them differs
  // from its eight nearest neighbours.
  PointCloud cloud = test::sphere_points(600);
  for (std::size_t i = 0; i < 9000; ++i) {
    cloud.points.push_back(cloud.points[i % 600] + 1e-12 * test::random_direction(5, i));
    cloud.normals.push_back(cloud.normals[i % 600]);
  }
  Scene scene(cloud, 4 * pi);
  std::fill(scene.spacing.begin(), scene.spacing.end(), 0.0);
  for (const Vec3& v : field_normals(scene.tree, scene.points, scene.spacing, 0.5, {})) {
    EXPECT_TRUE(is_finite(v));
  }
}

TEST(thin_out, keeps_points_apart_and_none_of_the_others_alone) {
  const test::OrderedCloud cloud(test::sphere_points(3000));
  const std::vector<Vec3>& points = cloud.points;
  const double reach = 0.2;
  const std::vector<std::uint32_t> kept =
      thin_out(cloud.tree, points, std::vector<double>(points.size(), reach));
  for (std::size_t a = 0; a < kept.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) EXPECT_GT(norm(points[kept[a]] - points[kept[b]]), reach);
  }
  for (const Vec3& p : points) {
    double nearest = 2;
    for (const std::uint32_t k : kept) nearest = std::min(nearest, norm(p - points[k]));
    EXPECT_LE(nearest, reach * 1.000001);
  }
}

}  // namespace
}  // namespace rholm
