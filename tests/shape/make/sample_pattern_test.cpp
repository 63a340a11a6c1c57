#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/primitives.h"

namespace rholm {
namespace {

using std::numbers::pi;

// Splits values into groups where neighbours differ by more than `tolerance`; returns sorted means.
std::vector<double> groups_of(std::vector<double> values, double tolerance) {
  std::sort(values.begin(), values.end());
  std::vector<double> means;
  for (std::size_t i = 0; i < values.size();) {
    double sum = 0;
    std::size_t j = i;
    for (; j < values.size() && (j == i || values[j] - values[j - 1] < tolerance); ++j) {
      sum += values[j];
    }
    means.push_back(sum / static_cast<double>(j - i));
    i = j;
  }
  return means;
}

// Returns f of every point.
template <typename F>
std::vector<double> of_points(const PointCloud& cloud, const F& f) {
  std::vector<double> values(cloud.points.size());
  std::transform(cloud.points.begin(), cloud.points.end(), values.begin(), f);
  return values;
}

void expect_even(const std::vector<double>& values, double step) {
  ASSERT_GT(values.size(), 2u);
  for (std::size_t i = 1; i < values.size(); ++i) {
    EXPECT_NEAR(values[i] - values[i - 1], step, 1e-9);
  }
}

const Attribute& attribute(const PointCloud& cloud, const std::string& name) {
  const auto found = std::find_if(cloud.attributes.begin(), cloud.attributes.end(),
                                  [&](const Attribute& a) { return a.name == name; });
  EXPECT_NE(found, cloud.attributes.end()) << name;
  return *found;
}

// A box of 2 x 2 x 4 has a curve of length 8 at each height. With steps of h along and 5 h across,
// there are 4 / (5 h) curves with 8 / h points.
TEST(sample_slices, lie_in_planes_and_are_as_far_apart_as_the_ratio_says) {
  const PointCloud cloud = sample_surface(
      box({2, 2, 4}), {.points = 3200, .pattern = SamplePattern::kSlices, .pattern_ratio = 5});
  const double h = std::sqrt(8 * 4 / (5 * 3200.0));
  const double slices = std::round(4 / (5 * h));
  const std::vector<double> heights = of_points(cloud, [&](const Vec3& p) { return p.z; });
  const std::vector<double> planes = groups_of(heights, 1e-9);
  EXPECT_EQ(static_cast<double>(planes.size()), slices);
  expect_even(planes, 4 / slices);
  const double around = std::round(8 / h);
  EXPECT_EQ(static_cast<double>(cloud.points.size()), slices * around);
  // Points follow the curve, which is straight except at four corners.
  std::size_t straight = 0;
  for (std::size_t i = 1; i < cloud.points.size(); ++i) {
    straight += std::abs(norm(cloud.points[i] - cloud.points[i - 1]) - 8 / around) < 1e-9;
  }
  EXPECT_GE(static_cast<double>(straight), slices * (around - 6));
}

TEST(sample_slices, go_across_the_axis_that_is_given) {
  const Vec3 axis = {1, 2, -2};
  const PointCloud cloud = sample_surface(icosphere(4), {.points = 2000,
                                                         .pattern = SamplePattern::kSlices,
                                                         .pattern_ratio = 4,
                                                         .pattern_axis = axis});
  const std::vector<double> heights =
      of_points(cloud, [&](const Vec3& p) { return dot(p, axis) / 3; });
  const std::vector<double> planes = groups_of(heights, 1e-9);
  // On the unit sphere, the lengths of curves over all heights add up to pi^2.
  const double step = 4 * std::sqrt(pi * pi / (4 * 2000.0));
  EXPECT_NEAR(static_cast<double>(planes.size()), 2 / step, 1.5);
  expect_even(planes, planes[1] - planes[0]);
  EXPECT_NEAR(static_cast<double>(cloud.points.size()), 2000, 60);
}

// Triangles without common vertices, as in STL, give the same curves.
TEST(sample_slices, do_not_depend_on_how_triangles_share_vertices) {
  const Mesh whole = icosphere(3);
  Mesh soup;
  for (const Triangle& t : whole.faces) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t v : t) soup.vertices.push_back(whole.vertices[v]);
    soup.faces.push_back({first, first + 1, first + 2});
  }
  const SampleOptions options{.points = 500, .pattern = SamplePattern::kSlices};
  const PointCloud a = sample_surface(whole, options), b = sample_surface(soup, options);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(a.points[i], b.points[i]);
}

TEST(sample_rings, lie_in_planes_through_the_axis_at_equal_angles) {
  const Mesh ring = torus(2, 0.5, 240, 120);
  const PointCloud cloud =
      sample_surface(ring, {.points = 4000, .pattern = SamplePattern::kRings, .pattern_ratio = 5});
  const std::vector<double> angles =
      of_points(cloud, [&](const Vec3& p) { return std::fmod(std::atan2(p.y, p.x) + pi, pi); });
  const std::vector<double> planes = groups_of(angles, 1e-9);
  expect_even(planes, pi / static_cast<double>(planes.size()));
  // Each plane has two circles of 2 pi 0.5. Steps across, at the mean distance 2, are five steps
  // along.
  const double points = static_cast<double>(cloud.points.size());
  const double along = 2 * pi * 0.5 / (points / (2 * static_cast<double>(planes.size())));
  const double across = 2 * pi / static_cast<double>(planes.size());
  EXPECT_NEAR(across / along, 5, 0.4);
  EXPECT_NEAR(points, 4000, 200);
}

TEST(sample_grid, of_a_box_is_a_lattice_on_each_face) {
  const PointCloud cloud = sample_surface(
      box({1, 2, 3}), {.points = 4400, .pattern = SamplePattern::kGrid, .pattern_ratio = 4});
  EXPECT_NEAR(static_cast<double>(cloud.points.size()), 4400, 400);
  std::vector<double> x, y;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.normals[i].z < 0.5) continue;
    x.push_back(cloud.points[i].x), y.push_back(cloud.points[i].y);
  }
  // The area is 22: with steps of h and 4 h, 22 / (4 h^2) = 4400.
  const double h = std::sqrt(22 / (4 * 4400.0));
  const std::vector<double> columns = groups_of(x, 1e-9), rows = groups_of(y, 1e-9);
  const bool fine_x = columns[1] - columns[0] < rows[1] - rows[0];
  expect_even(columns, fine_x ? h : 4 * h);
  expect_even(rows, fine_x ? 4 * h : h);
  EXPECT_EQ(x.size(), columns.size() * rows.size());
}

TEST(sample_scans, see_what_faces_their_scanners) {
  for (const SamplePattern pattern : {SamplePattern::kRandom, SamplePattern::kLines}) {
    const PointCloud cloud = sample_surface(
        icosphere(4),
        {.points = 6000, .pattern = pattern, .pattern_ratio = 3, .scans = 5, .sensor = true});
    EXPECT_NEAR(static_cast<double>(cloud.points.size()), 6000, 300);
    const auto &scan = attribute(cloud, "scan").values, &x = attribute(cloud, "sensor_x").values,
               &y = attribute(cloud, "sensor_y").values, &z = attribute(cloud, "sensor_z").values;
    std::map<double, int> points_of;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      ++points_of[scan[i]];
      const Vec3 at{x[i], y[i], z[i]};
      EXPECT_NEAR(norm(at), 3, 1e-2);
      EXPECT_GT(dot(at - cloud.points[i], cloud.normals[i]), 0);
    }
    ASSERT_EQ(points_of.size(), 5u);
    for (const auto& [k, n] : points_of) EXPECT_NEAR(n, 1200, 100) << k;
  }
}

// Each of two balls hides a part of the other from a scanner: no ray to a point may pass through a
// ball.
TEST(sample_scans, do_not_see_through_the_surface) {
  Mesh two = icosphere(3);
  const Mesh one = two;
  for (const Vec3& v : one.vertices) two.vertices.push_back(v + Vec3{2.5, 0, 0});
  const auto n = static_cast<std::uint32_t>(one.vertices.size());
  for (const Triangle& t : one.faces) two.faces.push_back({t[0] + n, t[1] + n, t[2] + n});
  const PointCloud cloud = sample_surface(two, {.points = 4000, .scans = 12, .sensor = true});
  const auto &x = attribute(cloud, "sensor_x").values, &y = attribute(cloud, "sensor_y").values,
             &z = attribute(cloud, "sensor_z").values;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3 at{x[i], y[i], z[i]}, ray = cloud.points[i] - at;
    const bool on_first = cloud.points[i].x < 1.25;
    const Vec3 other = on_first ? Vec3{2.5, 0, 0} : Vec3{0, 0, 0};
    // The polyhedron contains a ball of radius .98.
    const double along = std::clamp(dot(other - at, ray) / dot(ray, ray), 0.0, 1.0);
    EXPECT_GT(norm(at + along * ray - other), 0.98);
  }
}

TEST(sample_scans, are_off_by_the_distance_asked_for) {
  constexpr int kScansOfTest = 600;
  const Mesh body = ellipsoid({3, 2, 1}, 3);
  SampleOptions options{.points = 12000, .scans = kScansOfTest};
  const PointCloud right = sample_surface(body, options);
  options.misalignment = 0.01;
  const PointCloud off = sample_surface(body, options);
  ASSERT_EQ(right.points.size(), off.points.size());
  double sum = 0;
  for (std::size_t i = 0; i < right.points.size(); ++i) {
    const Vec3 d = off.points[i] - right.points[i];
    sum += dot(d, d) / static_cast<double>(right.points.size());
  }
  const double wanted = 0.01 * 2 * std::sqrt(14.0);
  // The sum has squares of six Gaussian numbers per scan, with unequal weights, each with a
  // deviation of sqrt(2 / 3) of its mean. The bound is five deviations; scanners do not see the
  // whole surface.
  EXPECT_NEAR(std::sqrt(sum), wanted, wanted * (2.5 * std::sqrt(2 / 3.0 / kScansOfTest) + 0.03));
}

TEST(sample_scans, have_more_noise_one_after_the_other) {
  const Mesh ball = icosphere(5);
  const PointCloud clean = sample_surface(ball, {.points = 20000, .scans = 3});
  const PointCloud noisy =
      sample_surface(ball, {.points = 20000, .noise = 0.001, .scans = 3, .scan_noise = 0.004});
  const auto& scan = attribute(noisy, "scan").values;
  std::array<double, 3> sum{}, n{};
  for (std::size_t i = 0; i < noisy.points.size(); ++i) {
    const Vec3 d = noisy.points[i] - clean.points[i];
    const auto k = static_cast<std::size_t>(scan[i]);
    sum[k] += dot(d, d), n[k] += 3;
  }
  const double diagonal = 2 * std::sqrt(3.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const double wanted = (0.001 + 0.002 * static_cast<double>(k)) * diagonal;
    EXPECT_NEAR(std::sqrt(sum[k] / n[k]), wanted, wanted * 5 / std::sqrt(2 * n[k])) << k;
  }
}

TEST(sample_pattern, is_the_same_for_any_number_of_threads) {
  const Mesh ring = torus(2, 0.7, 60, 30);
  for (const SamplePattern pattern : {SamplePattern::kSlices, SamplePattern::kRings,
                                      SamplePattern::kGrid, SamplePattern::kLines}) {
    SampleOptions options{.points = 3000, .noise = 0.001, .pattern = pattern, .pattern_ratio = 7};
    if (pattern == SamplePattern::kLines) options.scans = 4;
    const PointCloud one = sample_surface(ring, options, {.threads = 1});
    const PointCloud four = sample_surface(ring, options, {.threads = 4});
    ASSERT_EQ(one.points.size(), four.points.size());
    EXPECT_NEAR(static_cast<double>(one.points.size()), 3000, 300) << to_string(pattern);
    EXPECT_EQ(one.points, four.points);
    EXPECT_EQ(one.normals, four.normals);
  }
}

TEST(sample_pattern, that_never_meets_the_surface_is_refused) {
  Mesh flat{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}, .attributes = {}};
  EXPECT_THROW(sample_surface(flat, {.pattern = SamplePattern::kSlices}), Error);
  EXPECT_EQ(sample_surface(flat, {.points = 100, .pattern = SamplePattern::kGrid}).normals[0],
            (Vec3{0, 0, 1}));
  // A needle across the grid: its interior is sampled, not its whole bounding box.
  flat.vertices = {{0, 0, 0}, {1, 0.618, 0}, {1, 0.618001, 0}};
  EXPECT_NEAR(
      static_cast<double>(
          sample_surface(flat, {.points = 1000, .pattern = SamplePattern::kGrid}).points.size()),
      1000, 300);
}

TEST(sample_pattern, refuses_what_does_not_go_together) {
  const auto refused = [](const SampleOptions& options) {
    EXPECT_THROW(sample_surface(icosphere(1), options), Error);
  };
  refused({.pattern_ratio = 0.5});
  refused({.pattern_ratio = 1001});
  refused({.pattern_axis = {0, 0, 0}});
  refused({.pattern_axis = {std::nan(""), 0, 1}});
  refused({.pattern = SamplePattern::kLines});
  refused({.pattern = SamplePattern::kGrid, .scans = 3});
  refused({.scans = -1});
  refused({.scans = kMaxScans + 1});
  refused({.misalignment = 0.1});
  refused({.scan_noise = 0.1});
  refused({.sensor = true});
  refused({.scans = 2, .misalignment = -1});
  EXPECT_THROW(parse_name<SamplePattern>("spiral"), Error);
  for (const SamplePattern pattern :
       {SamplePattern::kRandom, SamplePattern::kSlices, SamplePattern::kRings,
        SamplePattern::kLines, SamplePattern::kGrid}) {
    EXPECT_EQ(parse_name<SamplePattern>(to_string(pattern)), pattern);
  }
}

}  // namespace
}  // namespace rholm
