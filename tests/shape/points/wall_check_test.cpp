// Points on a surface, and points that fill the space between its walls or around it.
#include "shape/points/wall_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/test_points.h"

namespace rholm {
namespace {

using test::OrderedCloud;
using test::points_of;
using test::random_direction;
using test::random_in;
using test::random_normal;
using test::uniform;

constexpr std::size_t kPoints = 4000;
constexpr double kStep = 0.03;

struct Surface {
  std::vector<WallVertex> vertices = {};

  Mesh mesh() const {
    Mesh mesh;
    for (const WallVertex& vertex : vertices) mesh.vertices.push_back(vertex.at);
    for (const char axis : std::string("xyz")) {
      Attribute normal{std::string("n") + axis, ScalarType::kFloat64, {}};
      for (const WallVertex& v : vertices) {
        normal.values.push_back(axis == 'x' ? v.normal.x : axis == 'y' ? v.normal.y : v.normal.z);
      }
      mesh.attributes.push_back(normal);
    }
    return mesh;
  }
};

// Returns two squares of edge 2 at this distance.
Surface plate(double thickness) {
  Surface surface;
  for (double x = -1; x <= 1; x += kStep) {
    for (double y = -1; y <= 1; y += kStep) {
      for (const double side : {-1.0, 1.0}) {
        surface.vertices.push_back({{x, y, side * thickness / 2}, {0, 0, side}});
      }
    }
  }
  return surface;
}

Surface sphere() {
  Surface surface;
  for (std::size_t i = 0; i < 20000; ++i) {
    const Vec3 direction = random_direction(5, i);
    surface.vertices.push_back({direction, direction});
  }
  return surface;
}

std::vector<Vec3> noisy_plate(double thickness, double noise) {
  return points_of(kPoints, [&](std::size_t i) {
    const double side = i % 2 == 0 ? 0.5 : -0.5;
    return Vec3{uniform(1, i), uniform(2, i), side * thickness + noise * random_normal(3, i)};
  });
}

WallPatches patches_of(const std::vector<Vec3>& points, int threads = 1) {
  const OrderedCloud cloud(points);
  Context context;
  context.threads = threads;
  return choose_patches(cloud.tree, cloud.points, {}, points.size(), 0, context);
}

double off(const std::vector<Vec3>& points, const Surface& surface) {
  const WallPatches patches = patches_of(points);
  EXPECT_GT(patches.size(), 100U);
  return check_walls(patches, surface.vertices, kStep, {}).share();
}

TEST(wall_check, finds_walls_nearer_than_a_few_deviations_of_the_noise) {
  for (const double thickness : {0.1, 0.3}) {
    EXPECT_LT(off(noisy_plate(thickness, thickness / 10), plate(thickness)), 0.05) << thickness;
    EXPECT_GT(off(noisy_plate(thickness, thickness / 3), plate(thickness)), 0.9) << thickness;
  }
}

// Whatever the distance of the walls is, it is at most 4 times the scatter.
TEST(wall_check, finds_points_that_fill_a_plate) {
  const double thickness = 0.3;
  const std::vector<Vec3> points = points_of(kPoints, [&](std::size_t i) {
    return Vec3{uniform(1, i), uniform(2, i), thickness / 2 * uniform(3, i)};
  });
  for (const double apart : {0.5, 0.7, 1.0}) {
    EXPECT_GT(off(points, plate(apart * thickness)), 0.7) << apart;
  }
}

// 4000 points of the unit sphere have the spacing 0.056.
TEST(wall_check, tells_points_that_fill_a_shell_from_noise_of_the_same_scatter) {
  const double half = 0.08;
  const std::vector<Vec3> evenly = points_of(
      kPoints, [&](std::size_t i) { return (1 + half * uniform(1, i)) * random_direction(2, i); });
  const std::vector<Vec3> noise = points_of(kPoints, [&](std::size_t i) {
    return (1 + half / std::sqrt(3.0) * random_normal(1, i)) * random_direction(2, i);
  });
  const std::vector<Vec3> one_layer = points_of(kPoints, [&](std::size_t i) {
    return (1 + half / 8 * uniform(1, i)) * random_direction(2, i);
  });
  EXPECT_GT(off(evenly, sphere()), 0.8);
  EXPECT_EQ(off(noise, sphere()), 0);
  EXPECT_EQ(off(one_layer, sphere()), 0);
}

TEST(wall_check, finds_points_far_from_any_surface) {
  const std::vector<Vec3> ball = points_of(kPoints, [](std::size_t i) {
    return std::cbrt(random_in(0, 1, 1, i)) * random_direction(2, i);
  });
  EXPECT_GT(off(ball, sphere()), 0.5);
  EXPECT_EQ(off(ball, {}), 1);
}

TEST(wall_check, names_points_that_are_off) {
  const std::vector<Vec3> points = points_of(kPoints, [](std::size_t i) {
    const double height = uniform(1, i) < 0 ? 0.05 : 0.4 * random_in(0, 1, 3, i);
    return Vec3{uniform(1, i), uniform(2, i), height * (i % 2 == 0 ? 1 : -1)};
  });
  const WallCheck check = check_walls(patches_of(points), plate(0.1).vertices, kStep, {});
  ASSERT_GE(check.off, kNamedWalls);
  EXPECT_NEAR(check.share(), 0.5, 0.15);
  for (const Vec3& at : check.at) EXPECT_GT(at.x, -0.2);
}

TEST(wall_check, needs_only_the_vertices_near_patches) {
  const std::vector<Vec3> points = noisy_plate(0.2, 0.05);
  Surface surface = plate(0.2);
  const WallCheck all = check_walls(patches_of(points), surface.vertices, kStep, {});
  const std::size_t near = surface.vertices.size();
  for (const double x : {50.0, -1e30, 1e300}) surface.vertices.push_back({{x, 0, 0}, {0, 0, 1}});
  Mesh mesh = surface.mesh();
  const WallPatches patches = patches_of(points);
  const auto kept = vertices_near(patches, kStep, mesh, mesh.vertices.size());
  EXPECT_LE(kept.size(), near);
  EXPECT_EQ(vertices_near(patches, kStep, mesh, 10).size(), 10U);
  const WallCheck some = check_walls(patches, kept, kStep, {});
  EXPECT_GT(some.off, 0U);
  const WallCheck whole = check_walls(patches, mesh, kStep, {});
  EXPECT_EQ(whole.patches, patches.size());
  EXPECT_EQ(whole.at, all.at);
  EXPECT_EQ(some.off, all.off);
  EXPECT_EQ(some.at, all.at);
}

TEST(wall_check, looks_at_a_third_where_few_are_off) {
  const WallPatches patches = patches_of(noisy_plate(0.3, 0.02));
  Mesh mesh = plate(0.3).mesh();
  const WallCheck check = check_walls(patches, mesh, kStep, {});
  EXPECT_EQ(check.patches, (patches.size() + 2) / 3);
  EXPECT_LT(check.share(), 0.1);
}

TEST(wall_check, is_the_same_in_parts_and_by_any_number_of_threads) {
  const std::vector<Vec3> points = noisy_plate(0.2, 0.05);
  const std::vector<WallVertex> vertices = plate(0.2).vertices;
  const WallPatches whole = patches_of(points), threads = patches_of(points, 3);
  EXPECT_EQ(threads.points, whole.points);
  Context three;
  three.threads = 3;
  const WallCheck one = check_walls(whole, vertices, kStep, {});
  EXPECT_EQ(check_walls(whole, vertices, kStep, three).at, one.at);
  WallPatches parts;
  for (const double part : {-1.0, 1.0}) {
    const OrderedCloud cloud(points);
    std::vector<std::uint8_t> foreign;
    foreign.reserve(points.size());
    for (const Vec3& p : cloud.points) foreign.push_back(p.x * part > 0 ? 1 : 0);
    const WallPatches some =
        choose_patches(cloud.tree, cloud.points, foreign, points.size(), 0, {});
    parts.points.insert(parts.points.end(), some.points.begin(), some.points.end());
    parts.areas.insert(parts.areas.end(), some.areas.begin(), some.areas.end());
  }
  EXPECT_EQ(parts.size(), whole.size());
  const WallCheck joined = check_walls(parts, vertices, kStep, {});
  EXPECT_EQ(joined.off, one.off);
  EXPECT_EQ(joined.at, one.at);
}

TEST(wall_check, takes_few_points) {
  const std::vector<Vec3> few = {{0, 0, 0.1}, {0.1, 0, 0.1}, {0, 0.1, 0.1}};
  const OrderedCloud cloud(few);
  const WallPatches patches = choose_patches(cloud.tree, cloud.points, {}, 3, 0, {});
  ASSERT_EQ(patches.size(), 3U);
  EXPECT_EQ(check_walls(patches, plate(0.2).vertices, kStep, {}).off, 0U);
  EXPECT_EQ(check_walls({}, plate(0.2).vertices, kStep, {}).share(), 0);
}

}  // namespace
}  // namespace rholm
