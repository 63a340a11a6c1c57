#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "rholm/topology.h"

namespace rholm {
namespace {

using std::numbers::pi;

// Returns the square 0 ... side in the plane z = 0.
Mesh square(double side) {
  return {.vertices = {{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}},
          .faces = {{0, 1, 2}, {0, 2, 3}},
          .attributes = {}};
}

TEST(sample, of_a_box_lies_on_it_with_the_normals_of_its_faces) {
  const PointCloud cloud = sample_surface(box({2, 4, 6}), {.points = 5000});
  ASSERT_EQ(cloud.points.size(), 5000u);
  ASSERT_EQ(cloud.normals.size(), 5000u);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3 p = cloud.points[i], n = cloud.normals[i];
    EXPECT_EQ(std::abs(n.x) + std::abs(n.y) + std::abs(n.z), 1.0);
    // n . p is half of the box's edge along n.
    EXPECT_NEAR(dot(n, p), std::abs(n.x) * 1 + std::abs(n.y) * 2 + std::abs(n.z) * 3, 1e-14);
    EXPECT_LE(std::abs(p.x), 1 + 1e-14);
    EXPECT_LE(std::abs(p.y), 2 + 1e-14);
    EXPECT_LE(std::abs(p.z), 3 + 1e-14);
  }
}

TEST(sample, has_points_in_proportion_to_area) {
  constexpr double n = 100000;
  const PointCloud cloud = sample_surface(box({2, 4, 6}), {.points = static_cast<std::size_t>(n)});
  const auto share = [&](auto is_face) {
    return static_cast<double>(std::count_if(cloud.normals.begin(), cloud.normals.end(), is_face)) /
           n;
  };
  // Faces have 24, 24; 12, 12; 8, 8 of 88. The bound is five standard deviations of a binomial
  // share.
  const auto expect = [&](double measured, double p) {
    EXPECT_NEAR(measured, p, 5 * std::sqrt(p * (1 - p) / n));
  };
  expect(share([](const Vec3& v) { return v.x > 0.5; }), 24.0 / 88);
  expect(share([](const Vec3& v) { return v.y < -0.5; }), 12.0 / 88);
  expect(share([](const Vec3& v) { return v.z > 0.5; }), 8.0 / 88);
}

TEST(sample, within_a_triangle_is_uniform) {
  constexpr double n = 40000;
  const Mesh triangle{
      .vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}, .attributes = {}};
  const PointCloud cloud = sample_surface(triangle, {.points = static_cast<std::size_t>(n)});
  Vec3 mean;
  for (const Vec3& p : cloud.points) mean += p / n;
  // Barycentric coordinates have mean 1/3 and variance 1/18.
  EXPECT_NEAR(mean.x, 1.0 / 3, 5 * std::sqrt(1 / 18.0 / n));
  EXPECT_NEAR(mean.y, 1.0 / 3, 5 * std::sqrt(1 / 18.0 / n));
}

TEST(sample, noise_has_the_deviation_asked_for_along_every_axis) {
  constexpr std::size_t n = 40000;
  const double sigma = 0.01 * std::sqrt(2.0);  // 1 % of the square's diagonal
  const PointCloud clean = sample_surface(square(1), {.points = n});
  const PointCloud noisy = sample_surface(square(1), {.points = n, .noise = 0.01});
  Vec3 variance;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 d = noisy.points[i] - clean.points[i];
    variance += Vec3{d.x * d.x, d.y * d.y, d.z * d.z} / n;
  }
  // The measured variance of Gaussian numbers has a relative deviation of sqrt(2 / n).
  for (const double v : {variance.x, variance.y, variance.z}) {
    EXPECT_NEAR(v / (sigma * sigma), 1, 5 * std::sqrt(2.0 / n));
  }
}

TEST(sample, noise_of_normals_has_the_deviation_asked_for) {
  constexpr std::size_t n = 40000;
  const PointCloud cloud = sample_surface(square(1), {.points = n, .normal_noise = 15});
  double mean2 = 0;
  Vec3 mean;
  for (const Vec3& normal : cloud.normals) {
    EXPECT_NEAR(norm(normal), 1, 1e-14);
    mean2 += std::pow(std::acos(std::clamp(normal.z, -1.0, 1.0)) * 180 / pi, 2) / n;
    mean += normal / n;
  }
  EXPECT_NEAR(mean2 / (15 * 15), 1, 5 * std::sqrt(2.0 / n));
  // Along x the value is sin(angle) cos(phi), with a variance below sigma^2 / 2.
  EXPECT_NEAR(mean.x, 0, 5 * (15 * pi / 180) * std::sqrt(0.5 / n));
  EXPECT_NEAR(mean.y, 0, 5 * (15 * pi / 180) * std::sqrt(0.5 / n));
}

TEST(sample, outliers_are_their_share_of_the_points_and_stay_in_the_grown_box) {
  const PointCloud cloud = sample_surface(box({2, 2, 2}), {.points = 1000, .outliers = 0.25});
  ASSERT_EQ(cloud.points.size(), 1000u);
  std::size_t off = 0;
  for (const Vec3& p : cloud.points) {
    const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    EXPECT_LE(largest, 1.1);
    off += std::abs(largest - 1) > 1e-12;
  }
  EXPECT_EQ(off, 250u);
}

TEST(sample, holes_are_empty_and_the_rest_is_as_it_was) {
  const Mesh mesh = icosphere(4);
  const PointCloud whole = sample_surface(mesh, {.points = 20000});
  const PointCloud cloud = sample_surface(mesh, {.points = 20000, .holes = 1, .hole_radius = 0.1});
  // A ball of radius r = 0.1 * 2 sqrt(3) (for the sphere's box) about a point of the unit sphere
  // cuts out r^2 / 4 of the area.
  const double share = 0.03;
  const double kept = static_cast<double>(cloud.points.size()) / 20000;
  EXPECT_NEAR(kept, 1 - share, 5 * std::sqrt(share / 20000) + 1e-3);
  std::size_t k = 0;
  std::vector<Vec3> removed;
  for (const Vec3& p : whole.points) {
    if (k < cloud.points.size() && cloud.points[k] == p) {
      ++k;
    } else {
      removed.push_back(p);
    }
  }
  EXPECT_EQ(k, cloud.points.size());
  // The removed points lie within one ball, and no remaining point is near its middle.
  const Bounds hole = bounds(removed);
  EXPECT_LE(hole.max.x - hole.min.x, 0.4 * std::sqrt(3.0));
  Vec3 middle;
  for (const Vec3& p : removed) middle += p / static_cast<double>(removed.size());
  for (const Vec3& p : cloud.points) EXPECT_GT(norm(p - normalized(middle)), 0.3);
}

TEST(sample, density_falls_by_the_ratio_along_the_longest_axis) {
  // On a strip of length 1 the density is proportional to exp(-ln(q) x). The half with small x has
  // (1 - q^-1/2) / (1 - 1/q) of the points.
  const Mesh strip{.vertices = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 1, 0}, {0, 1, 0}},
                   .faces = {{0, 1, 2}, {0, 2, 3}},
                   .attributes = {}};
  constexpr double n = 20000, q = 30;
  const PointCloud cloud =
      sample_surface(strip, {.points = static_cast<std::size_t>(n), .density_ratio = q});
  const double expected = (1 - 1 / std::sqrt(q)) / (1 - 1 / q);
  const double measured =
      static_cast<double>(std::count_if(cloud.points.begin(), cloud.points.end(),
                                        [](const Vec3& p) { return p.y < 0.5; })) /
      n;
  EXPECT_NEAR(measured, expected, 5 * std::sqrt(expected * (1 - expected) / n));
}

TEST(sample, is_the_same_for_any_threads_and_another_for_another_seed) {
  const Mesh mesh = torus(1, 0.3, 40, 20);
  const SampleOptions options{.points = 20000,
                              .noise = 0.01,
                              .normal_noise = 10,
                              .outliers = 0.1,
                              .holes = 3,
                              .hole_radius = 0.05,
                              .density_ratio = 5};
  const PointCloud one = sample_surface(mesh, options, {.threads = 1});
  const PointCloud two = sample_surface(mesh, options, {.threads = 2});
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.normals, two.normals);
  SampleOptions other = options;
  other.seed = 2;
  EXPECT_NE(one.points, sample_surface(mesh, other).points);
}

// Adds the value 1 + x - 2 y + 3 z at every vertex, with that name and type.
void add_linear(Mesh& mesh, const std::string& name, ScalarType type) {
  Attribute attribute{.name = name, .type = type, .values = {}};
  for (const Vec3& v : mesh.vertices) attribute.values.push_back(1 + v.x - 2 * v.y + 3 * v.z);
  mesh.attributes.push_back(std::move(attribute));
}

TEST(sample, has_the_attributes_of_its_places) {
  Mesh mesh = box({2, 4, 6});  // values at its corners are -9, -7, ... 11
  const SampleOptions options{.points = 5000, .holes = 2, .hole_radius = 0.1};
  const PointCloud plain = sample_surface(mesh, options);
  add_linear(mesh, "linear", ScalarType::kFloat64);
  add_linear(mesh, "nx", ScalarType::kFloat32);  // the sample has its own normals
  add_linear(mesh, "whole", ScalarType::kInt16);
  add_linear(mesh, "single", ScalarType::kFloat32);
  const PointCloud cloud = sample_surface(mesh, options, {.threads = 1});
  EXPECT_EQ(cloud.points, plain.points);
  EXPECT_EQ(cloud.normals, plain.normals);
  ASSERT_EQ(cloud.attributes.size(), 3u);
  const Attribute &linear = cloud.attributes[0], &whole = cloud.attributes[1],
                  &single = cloud.attributes[2];
  EXPECT_EQ(linear.name, "linear");
  EXPECT_EQ(whole.name, "whole");
  EXPECT_EQ(whole.type, ScalarType::kInt16);
  EXPECT_EQ(single.type, ScalarType::kFloat32);
  ASSERT_EQ(linear.values.size(), cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3 p = cloud.points[i];
    // Coordinates and values are below 12, with about ten roundings each: 12 * 10 * 2^-53.
    EXPECT_NEAR(linear.values[i], 1 + p.x - 2 * p.y + 3 * p.z, 1.4e-14);
    EXPECT_EQ(whole.values[i], std::round(linear.values[i]));
    EXPECT_EQ(single.values[i], static_cast<double>(static_cast<float>(linear.values[i])));
  }
  const PointCloud two = sample_surface(mesh, options, {.threads = 2});
  EXPECT_EQ(two.attributes[0].values, linear.values);
}

TEST(sample, has_attributes_from_before_the_noise_and_of_the_surface_for_outliers) {
  Mesh mesh = square(1);
  add_linear(mesh, "linear", ScalarType::kFloat64);
  const PointCloud clean = sample_surface(mesh, {.points = 1000});
  const PointCloud noisy = sample_surface(mesh, {.points = 1000, .noise = 0.1});
  EXPECT_NE(noisy.points, clean.points);
  EXPECT_EQ(noisy.attributes[0].values, clean.attributes[0].values);
  const PointCloud isolated = sample_surface(mesh, {.points = 1000, .outliers = 1});
  for (const double value : isolated.attributes[0].values) {
    EXPECT_GE(value, -1);  // at (0, 1)
    EXPECT_LE(value, 2);   // at (1, 0)
  }
}

TEST(sample, has_no_attribute_that_is_not_a_number_where_a_corner_has_one) {
  Mesh mesh = square(1);
  mesh.attributes = {{"q", ScalarType::kFloat64, {NAN, 5, INFINITY, 5}}};
  const PointCloud cloud = sample_surface(mesh, {.points = 100});
  for (const double value : cloud.attributes[0].values) EXPECT_NEAR(value, 5, 1e-15 * 5);
}

TEST(sample, scales_and_shifts_with_its_mesh) {
  const Mesh mesh = icosphere(2);
  for (const double scale : {1e-150, 1e-6, 1e6, 1e150}) {
    Mesh other = mesh;
    for (Vec3& v : other.vertices) v = scale * v + Vec3{scale, 0, 0};
    const PointCloud a = sample_surface(mesh, {.points = 100, .noise = 0.01});
    const PointCloud b = sample_surface(other, {.points = 100, .noise = 0.01});
    for (std::size_t i = 0; i < 100; ++i) {
      EXPECT_LE(norm((b.points[i] / scale - Vec3{1, 0, 0}) - a.points[i]), 1e-12);
    }
  }
}

TEST(sample, refuses_what_has_no_area_and_options_out_of_range) {
  const auto refuse = [](const Mesh& mesh, const SampleOptions& options) {
    try {
      sample_surface(mesh, options);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
    }
  };
  refuse({}, {});
  refuse({.vertices = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, .faces = {{0, 1, 2}}, .attributes = {}},
         {});
  const Mesh mesh = icosphere(0);
  refuse(mesh, {.points = 0});
  refuse(mesh, {.points = kMaxPoints + 1});
  refuse(mesh, {.noise = -1});
  refuse(mesh, {.noise = NAN});
  refuse(mesh, {.normal_noise = 181});
  refuse(mesh, {.outliers = 1.5});
  refuse(mesh, {.holes = -1});
  refuse(mesh, {.holes = 1, .hole_radius = NAN});
  refuse(mesh, {.density_ratio = 0.5});
}

TEST(largest_component, is_the_one_of_the_largest_area_without_the_others_vertices) {
  Mesh mesh = icosphere(2);
  const Mesh ball = icosphere(1);
  const std::size_t n = mesh.vertices.size();
  for (const Vec3& v : ball.vertices) mesh.vertices.push_back(5 * v + Vec3{9, 0, 0});
  for (Triangle t : ball.faces) {
    for (std::uint32_t& v : t) v += static_cast<std::uint32_t>(n);
    mesh.faces.push_back(t);
  }
  const Mesh largest = largest_component(mesh);
  EXPECT_EQ(largest.vertices.size(), ball.vertices.size());
  EXPECT_EQ(largest.faces.size(), ball.faces.size());
  EXPECT_NEAR(surface_area(largest), 25 * surface_area(ball), 1e-9);
  EXPECT_TRUE(largest_component({}).faces.empty());
}

}  // namespace
}  // namespace rholm
