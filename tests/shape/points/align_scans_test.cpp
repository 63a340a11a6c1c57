// Alignment of scans that are moved as rigid bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "shape/points/scan_motions.h"
#include "shape/points/sensors.h"
#include "support/random_data.h"
#include "support/test_points.h"

namespace rholm {
namespace {

constexpr Vec3 kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

// Returns the rms distance along the exact normals, after removal of a common motion.
double off_by(const std::vector<Vec3>& points, const PointCloud& truth) {
  std::vector<ScanPair> pairs;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const Vec3& axis : kAxes) pairs.push_back({0, 1, points[i], truth.points[i], axis});
  }
  const Vec3 middle;
  const std::vector<ScanBody> bodies = {body_of(points, middle, 1),
                                        body_of(truth.points, middle, 1)};
  const std::vector<RigidMotion> motions = solve_motions(pairs, bodies, middle, 1);
  double squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 rest = motions[0].point(points[i]) - motions[1].point(truth.points[i]);
    squares += std::pow(dot(rest, truth.normals[i]), 2);
  }
  return std::sqrt(squares / static_cast<double>(points.size()));
}

Mesh blade(double half) {
  Mesh mesh = icosphere(5);
  for (Vec3& v : mesh.vertices) v = {2 * v.x, v.y, half * v.z};
  return mesh;
}

SampleOptions eight_scans(double misalignment) {
  return {.points = 20000, .scans = 8, .misalignment = misalignment, .sensor = true};
}

TEST(scan_motions, exact_pairs_are_brought_together) {
  // Three moved scans of the same places. Pairs in all directions determine the motions completely.
  const std::vector<Vec3> places = test::sphere_points(200).points;
  const Vec3 middle{0.1, 0.2, 0.3};
  const RigidMotion off[] = {{middle, {1e-4, -2e-4, 0}, {3e-4, 0, 1e-4}},
                             {middle, {0, 1e-4, 3e-4}, {0, -2e-4, 2e-4}},
                             {middle, {-1e-4, 1e-4, -3e-4}, {-3e-4, 2e-4, -3e-4}}};
  std::vector<ScanPair> pairs;
  for (std::uint32_t a = 0; a < 3; ++a) {
    const std::uint32_t b = (a + 1) % 3;
    for (std::size_t i = 0; i < places.size(); ++i) {
      pairs.push_back({a, b, off[a].point(places[i]), off[b].point(places[i]), kAxes[i % 3]});
    }
  }
  std::vector<ScanBody> bodies;
  for (const RigidMotion& motion : off) {
    std::vector<Vec3> points;
    points.reserve(places.size());
    for (const Vec3& place : places) points.push_back(motion.point(place));
    bodies.push_back(body_of(points, middle, 2));
  }
  const std::vector<RigidMotion> motions = solve_motions(pairs, bodies, middle, 2);
  for (const ScanPair& pair : pairs) {
    const Vec3 rest = motions[pair.from].point(pair.a) - motions[pair.to].point(pair.b);
    // Some thousandths of the motions (up to 1e-3) remain, because motions are weighed against
    // rest.
    EXPECT_LT(norm(rest), 1e-5);
  }
}

TEST(scan_motions, what_no_pair_knows_of_stays) {
  // Pairs along z determine neither shifts in the plane nor turns about z.
  std::vector<ScanPair> pairs;
  const std::vector<Vec3> places = test::sphere_points(300).points;
  pairs.reserve(places.size());
  for (const Vec3& at : places) pairs.push_back({0, 1, at + Vec3{0.1, 0, 0.01}, at, {0, 0, 1}});
  const std::vector<ScanBody> bodies = {body_of(places, {}, 1), body_of(places, {}, 1)};
  for (const RigidMotion& motion : solve_motions(pairs, bodies, {}, 1)) {
    EXPECT_LT(std::abs(motion.shift.x), 1e-6);
    EXPECT_LT(std::abs(motion.turn.z), 1e-6);
    EXPECT_NEAR(std::abs(motion.shift.z), 0.005, 5e-5);
  }
}

TEST(align_scans, brings_eight_together_nightly) {
  const Mesh mesh = bumpy_sphere(5);
  const PointCloud truth = sample_surface(mesh, eight_scans(0));
  for (const bool sensors : {false, true}) {
    PointCloud cloud = sample_surface(mesh, eight_scans(0.02));
    cloud.normals.clear();
    if (!sensors)
      std::erase_if(cloud.attributes, [](const Attribute& a) { return a.name != "scan"; });
    const double before = off_by(cloud.points, truth);
    const ScanAlignment report = align_scans(cloud);
    EXPECT_EQ(report.scans, 8U);
    EXPECT_GT(report.pairs, 5000U);
    EXPECT_LT(off_by(cloud.points, truth), before / 20) << sensors;
    EXPECT_LT(report.distance, report.distance_before / 5);
    EXPECT_GT(report.moved, 0);
  }
}

TEST(align_scans, moves_normals_and_sensors_with_their_points) {
  const PointCloud before = sample_surface(bumpy_sphere(5), eight_scans(0.02));
  PointCloud after = before;
  align_scans(after);
  const std::vector<Vec3> from = sensors_of(before), to = sensors_of(after);
  for (std::size_t i = 0; i < before.points.size(); ++i) {
    const Vec3 sight = from[i] - before.points[i], moved = to[i] - after.points[i];
    EXPECT_NEAR(norm(moved), norm(sight), 1e-12 * norm(sight));
    EXPECT_NEAR(dot(moved, after.normals[i]), dot(sight, before.normals[i]), 1e-12 * norm(sight));
  }
}

TEST(align_scans, does_not_pull_the_sheets_of_a_blade_together) {
  // The blade is thinner than the misalignment: only normals distinguish its sheets.
  const Mesh mesh = blade(0.02);
  const PointCloud truth = sample_surface(mesh, eight_scans(0));
  PointCloud cloud = sample_surface(mesh, eight_scans(0.015));
  const double before = off_by(cloud.points, truth);
  align_scans(cloud);
  EXPECT_LT(off_by(cloud.points, truth), before / 3);
}

TEST(align_scans, leaves_what_fits_and_what_nothing_is_known_of) {
  // The scans of a ball could turn freely, and must not.
  const PointCloud ball = sample_surface(icosphere(6), eight_scans(0));
  PointCloud cloud = ball;
  EXPECT_LT(align_scans(cloud).moved, 1e-3);
  const auto unchanged = [&](const PointCloud& given, std::size_t scans) {
    cloud = given;
    EXPECT_EQ(align_scans(cloud).scans, scans);
    EXPECT_EQ(cloud.points, given.points);
  };
  PointCloud other = ball;
  other.attributes.clear();
  unchanged(other, 0);
  std::vector<double> values(ball.points.size(), 3);
  set_attribute(other.attributes, {"scan", ScalarType::kFloat32, values});
  unchanged(other, 1);
  values[5] = 0.5;
  set_attribute(other.attributes, {"scan", ScalarType::kFloat32, values});
  unchanged(other, 0);
  unchanged({}, 0);
}

TEST(align_scans, goes_through_with_scans_of_few_points_and_none_near) {
  PointCloud cloud = test::sphere_points(500);
  std::vector<double> scan(cloud.points.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    scan[i] = i < 100 ? static_cast<double>(i) : i < 300 ? -7 : 1e6;
    if (i >= 300) cloud.points[i] += Vec3{50, 0, 0};
  }
  set_attribute(cloud.attributes, {"scan", ScalarType::kFloat64, scan});
  const std::vector<Vec3> before = cloud.points;
  const ScanAlignment report = align_scans(cloud);
  EXPECT_EQ(report.scans, 102U);
  EXPECT_EQ(report.pairs, 0U);
  EXPECT_EQ(cloud.points, before);
}

TEST(align_scans, refuses_clouds_that_are_not_valid) {
  PointCloud cloud = test::sphere_points(100);
  cloud.points[3].x = std::nan("");
  EXPECT_THROW(align_scans(cloud), Error);
}

}  // namespace
}  // namespace rholm
