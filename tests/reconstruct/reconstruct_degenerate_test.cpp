// Degenerate points give a closed manifold or a clear error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "rholm/error.h"
#include "rholm/reconstruct.h"
#include "rholm/topology.h"
#include "support/random_data.h"
#include "support/reconstruct_checks.h"
#include "support/sizes.h"
#include "support/test_meshes.h"
#include "support/test_points.h"

namespace rholm {
namespace {

using test::expect_closed_manifold;
using test::expect_finite;
using test::expect_manifold;
using test::random_direction;
using test::random_in;
using test::refusal;
using test::sphere_points;

void expect_closed_or_refused(const PointCloud& cloud, const std::string& name) {
  SCOPED_TRACE(name);
  for (const HolePolicy holes : {HolePolicy::kFill, HolePolicy::kKeep}) {
    try {
      const Reconstruction made = reconstruct(cloud, {.holes = holes, .max_memory = 1 << 28});
      expect_finite(made.mesh);
      EXPECT_FALSE(made.mesh.faces.empty());
      const Inspection found = inspect(made.mesh);
      expect_manifold(found);
      if (holes == HolePolicy::kFill) {
        EXPECT_EQ(found.boundary_edges, 0U);
      }
    } catch (const Error& error) {
      // Points that nearly coincide need steps near zero.
      EXPECT_TRUE(error.code() == ErrorCode::kInvalidInput ||
                  error.code() == ErrorCode::kOutOfMemory)
          << error.what();
      EXPECT_GT(std::string(error.what()).size(), 20U);
    }
  }
}

// Runs with the normals given and without normals.
void expect_decent(PointCloud cloud, const std::string& name) {
  expect_closed_or_refused(cloud, name);
  cloud.normals.clear();
  expect_closed_or_refused(cloud, name + ", without normals");
}

PointCloud with_normals(std::vector<Vec3> points, const Vec3& normal) {
  const std::size_t n = points.size();
  return {.points = std::move(points), .normals = std::vector<Vec3>(n, normal), .attributes = {}};
}

TEST(ReconstructDegenerate, few_points) {
  for (const std::size_t n : {0, 1, 2, 3, 4, 8, 15, 16, 17, 24, 25, 32, 50, 100}) {
    expect_decent(sphere_points(n), std::to_string(n));
  }
  const std::string said = refusal(sphere_points(15));
  EXPECT_NE(said.find("15"), std::string::npos) << said;
  EXPECT_NE(said.find("16"), std::string::npos) << said;
}

TEST(ReconstructDegenerate, points_without_a_surface) {
  constexpr std::size_t n = 125;
  std::vector<Vec3> line, plane, grid, same(n, {1, 2, 3}), cloud, two;
  for (std::size_t i = 0; i < n; ++i) {
    line.push_back({random_in(0, 1, 1, i), 0, 0});
    plane.push_back({random_in(0, 1, 1, i), random_in(0, 1, 2, i), 0});
    const std::size_t row = i / 25;
    grid.push_back({static_cast<double>(i % 25), static_cast<double>(row), 7});
    cloud.push_back({random_in(0, 1, 1, i), random_in(0, 1, 2, i), random_in(0, 1, 3, i)});
    two.push_back({i % 2 == 0 ? 0.0 : 1.0, 1e-9 * static_cast<double>(i), 0});
  }
  const Vec3 up{0, 0, 1};
  const std::string said = refusal(with_normals(line, up));
  EXPECT_NE(said.find("one line"), std::string::npos) << said;
  expect_decent(with_normals(line, up), "line");
  expect_decent(with_normals(line, {1, 0, 0}), "line along its normals");
  expect_decent(with_normals(plane, up), "plane");
  expect_decent(with_normals(plane, {1, 0, 0}), "plane with normals within it");
  expect_decent(with_normals(grid, up), "grid");
  expect_decent(with_normals(same, up), "one place");
  expect_decent(with_normals(cloud, up), "a cube of points");
  expect_decent(with_normals(two, up), "two clusters");
  PointCloud random = with_normals(cloud, up);
  for (std::size_t i = 0; i < n; ++i) random.normals[i] = random_direction(4, i);
  expect_decent(random, "a cube of points with random normals");
}

TEST(ReconstructDegenerate, a_grid_too_coarse_for_the_shape_is_refused_with_its_step) {
  // The step is ten diameters.
  const PointCloud sphere = sphere_points(500);
  try {
    const Reconstruction made = reconstruct(sphere, {.step = 20});
    FAIL() << made.mesh.faces.size() << " triangles";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
    EXPECT_NE(std::string(error.what()).find("steps of 20 "), std::string::npos) << error.what();
  }
}

TEST(ReconstructDegenerate, bad_normals) {
  constexpr std::size_t kCount = 200;
  const PointCloud sphere = sphere_points(kCount);
  PointCloud cloud = sphere;
  for (Vec3& n : cloud.normals) n = -n;
  expect_closed_or_refused(cloud, "inwards");
  for (std::size_t i = 0; i < kCount; ++i) cloud.normals[i] = random_direction(2, i);
  expect_closed_or_refused(cloud, "random");
  for (std::size_t i = 0; i < kCount; ++i)
    cloud.normals[i] = (i % 2 == 0 ? 1.0 : -1.0) * sphere.normals[i];
  expect_closed_or_refused(cloud, "every second one turned");
  for (Vec3& n : cloud.normals) n = {};
  expect_closed_or_refused(cloud, "zero");
  cloud.normals[0] = {0, 0, 1};
  expect_closed_or_refused(cloud, "all but one zero");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (Vec3& n : cloud.normals) n = {nan, nan, nan};
  expect_closed_or_refused(cloud, "not a number");
  for (std::size_t i = 0; i < kCount; ++i)
    cloud.normals[i] = cross(sphere.normals[i], {0.1, 0.2, 1});
  expect_closed_or_refused(cloud, "tangential");
  for (std::size_t i = 0; i < kCount; ++i) cloud.normals[i] = 1e-200 * sphere.normals[i];
  expect_closed_or_refused(cloud, "tiny");
  for (std::size_t i = 0; i < kCount; ++i) cloud.normals[i] = 1e200 * sphere.normals[i];
  expect_closed_or_refused(cloud, "huge");
}

TEST(ReconstructDegenerate, the_same_places_again) {
  const PointCloud sphere = sphere_points(120);
  PointCloud cloud = sphere, nearly = sphere;
  for (int k = 1; k < 100; ++k) cloud = test::joined(cloud, sphere);
  expect_decent(cloud, "a hundred times");
  const Reconstruction made = reconstruct(cloud);
  EXPECT_EQ(made.report.dropped_points, 99 * 120U);
  const Mesh once = reconstruct(sphere).mesh;
  ASSERT_EQ(made.mesh.vertices.size(), once.vertices.size());
  // Means of a hundred normals have rounding errors.
  for (std::size_t i = 0; i < once.vertices.size(); ++i) {
    EXPECT_LT(norm(made.mesh.vertices[i] - once.vertices[i]), 1e-6);
  }
  PointCloud opposite = sphere;
  for (Vec3& n : opposite.normals) n = -n;
  expect_decent(test::joined(sphere, opposite), "with opposite normals");
  // Neighbours are equal in single precision.
  for (int k = 1; k < 20; ++k) {
    for (std::size_t i = 0; i < 300; ++i) {
      nearly.points.push_back(sphere.points[i] +
                              1e-9 * random_direction(11, 300 * static_cast<std::size_t>(k) + i));
      nearly.normals.push_back(sphere.normals[i]);
    }
  }
  expect_decent(nearly, "twenty times nearly");
}

TEST_OF_TWO_SIZES(ReconstructDegenerate, extremes_of_scale) {
  for (const double scale :
       {1e-310, 1e-200, 1e-100, 1e-30, 1e-13, 1e13, 1e30, 1e100, 1e200, 1e308}) {
    PointCloud cloud = sphere_points(200);
    for (Vec3& p : cloud.points) p *= scale;
    EXPECT_NE(refusal(cloud), "") << scale;
  }
  for (const double scale : {1e-12, 1e11}) {
    PointCloud cloud = sphere_points(200);
    for (Vec3& p : cloud.points) p *= scale;
    EXPECT_EQ(expect_closed_manifold(reconstruct(cloud).mesh).euler_characteristic, 2) << scale;
  }
  // The shape is moved away until doubles cannot represent it.
  for (const double shift : {1e6, 1e12, 1e15, 1e17}) {
    PointCloud cloud = sphere_points(nightly ? 300 : 100);
    for (Vec3& p : cloud.points) p += {shift, 0, 0};
    expect_decent(cloud, "at " + std::to_string(shift));
  }
  // One point lies far away from all others.
  for (const double far : nightly ? std::vector{1e3, 1e6, 1e9, 1e12} : std::vector{1e3, 1e9}) {
    PointCloud cloud = sphere_points(nightly ? 500 : 150);
    cloud.points.push_back({far, 0, 0});
    cloud.normals.push_back({1, 0, 0});
    expect_decent(cloud, "one at " + std::to_string(far));
  }
}

TEST_OF_TWO_SIZES(ReconstructDegenerate, thin_sheets) {
  // The two faces of the plate are nearer to each other than the points.
  for (const double thickness : {1e-1, 1e-3, 0.0}) {
    PointCloud plate;
    for (std::size_t i = 0; i < (nightly ? 700 : 200); ++i) {
      const double side = i % 2 == 0 ? 1 : -1;
      plate.points.push_back(
          {random_in(-1, 1, 1, i), random_in(-1, 1, 2, i), side * thickness / 2});
      plate.normals.push_back({0, 0, side});
    }
    expect_decent(plate, "plate of " + std::to_string(thickness));
  }
}

}  // namespace
}  // namespace rholm
