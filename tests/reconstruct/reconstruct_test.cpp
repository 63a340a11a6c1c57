// From points to surfaces. Oracles are bodies in closed form, exact counts of edges and vertex
// links, and exact distances to the mesh that was sampled.
#include "rholm/reconstruct.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "rholm/compare.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "rholm/topology.h"
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
using test::random_normal;
using test::refusal;
using test::sphere_points;

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double largest_support(const Atlas& atlas) {
  double largest = 0;
  for (const Cap& cap : atlas.caps) largest = std::max(largest, cap.frame.support);
  return largest;
}

Vec3 vertex_normal(const Mesh& mesh, std::size_t i) {
  return {find_attribute(mesh.attributes, "nx")->values[i],
          find_attribute(mesh.attributes, "ny")->values[i],
          find_attribute(mesh.attributes, "nz")->values[i]};
}

// ---- Bodies with a known surface ----

TEST(Reconstruct, a_sphere_is_exact_to_the_terms_that_caps_leave_out) {
  const Reconstruction made = reconstruct(sphere_points(10000));
  const Inspection found = expect_closed_manifold(made.mesh);
  EXPECT_EQ(found.euler_characteristic, 2);
  EXPECT_FALSE(found.inside_out);
  // Over a cap of radius R the sphere has the height d^2/2 + d^4/8 + ...; degree 3 represents the
  // first term. The slope of the second term is d^3/2.
  const double support = largest_support(made.model.atlas), r4 = std::pow(support, 4) / 8;
  for (std::size_t i = 0; i < made.mesh.vertices.size(); ++i) {
    const Vec3& v = made.mesh.vertices[i];
    EXPECT_NEAR(norm(v), 1, r4);
    EXPECT_LT(norm(vertex_normal(made.mesh, i) - v / norm(v)), std::pow(support, 3) / 2);
  }
  EXPECT_EQ(made.report.points, 10000U);
  EXPECT_EQ(made.report.outliers + made.report.dropped_points + made.report.holes, 0U);
  EXPECT_EQ(made.report.noise, 0);
  EXPECT_EQ(made.report.caps, made.model.atlas.caps.size());
  EXPECT_FALSE(made.report.computed_normals);
  // 10000 points on an area of 4 pi.
  EXPECT_NEAR(made.report.spacing, std::sqrt(4 * std::numbers::pi / 1e4),
              0.05 * made.report.spacing);
}

TEST(Reconstruct, normals_are_computed_where_there_are_none) {
  PointCloud cloud = sphere_points(3000);
  cloud.normals.clear();
  const Reconstruction made = reconstruct(std::move(cloud));
  const Inspection found = expect_closed_manifold(made.mesh);
  EXPECT_EQ(found.euler_characteristic, 2);
  EXPECT_FALSE(found.inside_out);
  EXPECT_TRUE(made.report.computed_normals);
}

TEST(Reconstruct, normals_into_the_solid_are_turned) {
  for (const double density_ratio : {1.0, 30.0}) {
    PointCloud cloud =
        sample_surface(torus(1, 0.4, 96, 48), {.points = 8000, .density_ratio = density_ratio});
    const Reconstruction right = reconstruct(cloud);
    EXPECT_FALSE(right.report.turned_normals);
    for (Vec3& normal : cloud.normals) normal = -normal;
    const Reconstruction turned = reconstruct(cloud);
    EXPECT_TRUE(turned.report.turned_normals);
    EXPECT_EQ(turned.mesh.vertices, right.mesh.vertices);
    EXPECT_EQ(turned.mesh.faces, right.mesh.faces);
  }
}

TEST(Reconstruct, normals_of_an_open_sheet_stay) {
  PointCloud half = sphere_points(4000);
  std::erase_if(half.points, [](const Vec3& p) { return p.z < 0; });
  half.normals.clear();
  for (const Vec3& p : half.points) half.normals.push_back(-p);
  EXPECT_FALSE(reconstruct(half).report.turned_normals);
}

TEST(Reconstruct, a_torus_has_a_hole_through_it) {
  const Mesh truth = torus(1, 0.3, 200, 80);
  const Reconstruction made = reconstruct(sample_surface(truth, {.points = 8000}));
  const Inspection found = expect_closed_manifold(made.mesh);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(found.genus, 1U);
  // In the sampled mesh, facets lie inside the tube by up to 1 - cos(pi / 80) of its radius.
  const double dent =
      0.3 * (1 - std::cos(std::numbers::pi / 80)) + std::pow(largest_support(made.model.atlas), 4);
  EXPECT_LT(rms(distances_to_surface(made.mesh.vertices, truth)), dent);
}

TEST(Reconstruct, parts_are_kept_or_dropped_by_their_share_of_the_largest) {
  PointCloud cloud = sphere_points(6000);
  for (const Vec3& u : sphere_points(600, 2).points) {
    cloud.points.push_back(0.3 * u + Vec3{3, 0, 0});  // 9 % of the area
    cloud.normals.push_back(u);
  }
  const Reconstruction both = reconstruct(cloud, {.min_component = 0});
  EXPECT_EQ(expect_closed_manifold(both.mesh).components, 2U);
  EXPECT_EQ(both.report.dropped_components, 0U);
  const Reconstruction one = reconstruct(cloud, {.min_component = 0.2});
  const Inspection found = expect_closed_manifold(one.mesh);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(one.report.dropped_components, 1U);
  EXPECT_LT(found.bounds.max.x, 1.1);
}

TEST(Reconstruct, edges_of_a_box_stay_within_their_neighbours) {
  const Mesh truth = box({2, 1.5, 1}, 1);
  const Reconstruction made = reconstruct(sample_surface(truth, {.points = 20000}));
  const Inspection found = expect_closed_manifold(made.mesh);
  EXPECT_EQ(found.euler_characteristic, 2);
  // At an edge caps shrink until they have few points: errors do not exceed their size.
  const std::vector<double> off = distances_to_surface(made.mesh.vertices, truth);
  EXPECT_LT(*std::max_element(off.begin(), off.end()), 3 * made.report.spacing);
  // Points of flat faces away from edges. On a cap of support R_0 tan(15 degrees) a plane is r =
  // R_0 / cos(theta), and degree 3 leaves at most its term 5 theta^4 / 24 as error.
  std::size_t n_flat = 0;
  const double margin = 2 * largest_support(made.model.atlas);
  for (std::size_t i = 0; i < off.size(); ++i) {
    const Vec3& v = made.mesh.vertices[i];
    if (v.z < 0.4 || std::abs(v.x) > 1 - margin || std::abs(v.y) > 0.75 - margin) continue;
    ++n_flat;
    EXPECT_LT(off[i], 0.0037 * largest_support(made.model.atlas));
  }
  EXPECT_GT(n_flat, 100U);
}

// ---- Holes ----

PointCloud open_sphere(std::size_t n, double highest) {
  PointCloud cloud = sphere_points(n), open;
  for (const Vec3& p : cloud.points) {
    if (p.z < highest) open.points.push_back(p);
  }
  open.normals = open.points;
  return open;
}

TEST(Reconstruct, a_hole_is_closed_by_a_surface_that_goes_on_as_its_border) {
  const Reconstruction made = reconstruct(open_sphere(10000, 0.8));
  const Inspection found = expect_closed_manifold(made.mesh);
  EXPECT_EQ(found.euler_characteristic, 2);
  EXPECT_EQ(made.report.holes, 1U);
  EXPECT_EQ(made.report.smooth_holes, 1U);
  // A flat lid over a hole of radius 0.6 would be 0.2 below the sphere.
  for (const Vec3& v : made.mesh.vertices) EXPECT_NEAR(norm(v), 1, 0.05);
}

TEST(Reconstruct, a_hole_can_be_kept_with_one_clean_border) {
  const Reconstruction made = reconstruct(open_sphere(10000, 0.8), {.holes = HolePolicy::kKeep});
  expect_finite(made.mesh);
  const Inspection found = inspect(made.mesh);
  expect_manifold(found);
  EXPECT_GT(found.boundary_edges, 0U);
  EXPECT_EQ(found.euler_characteristic, 1);  // a disc: one border
  for (const Vec3& v : made.mesh.vertices) {
    EXPECT_NEAR(norm(v), 1, 1e-3);
    EXPECT_LT(v.z, 0.8 + 3 * made.report.spacing);
  }
}

TEST(Reconstruct, a_bowl_that_is_kept_open_has_one_sheet) {
  // The normals point to the hollow side. From the other side the bowl fills less than half of the
  // view, so that the winding number closes it directly behind the points.
  PointCloud bowl = open_sphere(20000, -0.5);
  for (Vec3& normal : bowl.normals) normal = -normal;
  const Reconstruction made = reconstruct(bowl, {.holes = HolePolicy::kKeep});
  const Inspection found = inspect(made.mesh);
  expect_manifold(found);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(found.euler_characteristic, 1);  // a disc
  // The sphere is known. Along the border caps have points on one side only: of 12 bowls with other
  // points 9 leave the sphere there by more than a step, the farthest by 1.3, 0.8 of the spacing.
  const double spacing = made.report.spacing;
  for (const Vec3& v : made.mesh.vertices) {
    EXPECT_NEAR(norm(v), 1, v.z < -0.5 - 2 * spacing ? 1e-3 : spacing);
  }
}

TEST(Reconstruct, an_open_half_is_closed_or_kept) {
  const Inspection closed = expect_closed_manifold(reconstruct(open_sphere(10000, 0)).mesh);
  EXPECT_EQ(closed.euler_characteristic, 2);
  const Reconstruction kept = reconstruct(open_sphere(10000, 0), {.holes = HolePolicy::kKeep});
  const Inspection found = inspect(kept.mesh);
  expect_manifold(found);
  EXPECT_EQ(found.euler_characteristic, 1);
}

// ---- Bad data ----

// Noise of three spacings, in points without normals.
TEST_OF_TWO_SIZES(Reconstruct, noise_of_spacings_leaves_no_handles) {
  const std::size_t n = nightly ? 60000 : 10000;
  const double sigma = 3 * std::sqrt(4 * std::numbers::pi / static_cast<double>(n));
  PointCloud cloud = sphere_points(n);
  for (std::size_t i = 0; i < n; ++i) cloud.points[i] *= 1 + sigma * random_normal(11, i);
  cloud.normals.clear();
  const Reconstruction made = reconstruct(cloud);
  EXPECT_EQ(expect_closed_manifold(made.mesh).euler_characteristic, 2);
  EXPECT_NEAR(made.report.noise, sigma, 0.15 * sigma);
  double squares = 0;
  for (const Vec3& v : made.mesh.vertices) squares += (norm(v) - 1) * (norm(v) - 1);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(made.mesh.vertices.size())), 0.25 * sigma);
}

TEST_OF_TWO_SIZES(Reconstruct, noise_is_found_and_averaged_out) {
  constexpr double kSigma = 0.01;
  PointCloud cloud = sphere_points(nightly ? 20000 : 8000);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    cloud.points[i] *= 1 + kSigma * random_normal(7, i);
  }
  const Reconstruction made = reconstruct(cloud);
  EXPECT_EQ(expect_closed_manifold(made.mesh).euler_characteristic, 2);
  EXPECT_NEAR(made.report.noise, kSigma, 0.1 * kSigma);
  std::vector<double> off;
  off.reserve(made.mesh.vertices.size());
  for (const Vec3& v : made.mesh.vertices) off.push_back(norm(v) - 1);
  // Caps of k points with 16 coefficients leave sigma sqrt(16 / k), and a third of sigma at most.
  EXPECT_LT(rms(off), kSigma / 3);
  const ReconstructOptions told{.noise = 0.02};
  EXPECT_EQ(reconstruct(cloud, told).report.noise, 0.02);
}

TEST(Reconstruct, outliers_are_left_out) {
  PointCloud cloud = sphere_points(10000);
  for (std::size_t i = 0; i < 1000; ++i) {
    cloud.points.push_back({random_in(-1.2, 1.2, 8, 3 * i), random_in(-1.2, 1.2, 8, 3 * i + 1),
                            random_in(-1.2, 1.2, 8, 3 * i + 2)});
    cloud.normals.push_back(random_direction(9, i));
  }
  const Reconstruction made = reconstruct(cloud);
  const Inspection found = expect_closed_manifold(made.mesh);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(found.euler_characteristic, 2);
  EXPECT_GT(made.report.outliers, 900U);
  EXPECT_LT(made.report.outliers, 1100U);
  for (const Vec3& v : made.mesh.vertices) EXPECT_NEAR(norm(v), 1, 0.1);
}

TEST(Reconstruct, outliers_are_left_out_before_normals_are_found_nightly) {
  const PointCloud cloud =
      sample_surface(icosphere(5), {.points = 20000, .outliers = 0.1, .normals = false});
  const Reconstruction made = reconstruct(cloud);
  EXPECT_EQ(expect_closed_manifold(made.mesh).euler_characteristic, 2);
  for (const Vec3& v : made.mesh.vertices) EXPECT_NEAR(norm(v), 1, 0.05);
  // One point far away changes nothing.
  PointCloud one = sample_surface(icosphere(5), {.points = 5000, .normals = false});
  const Mesh expected = reconstruct(one).mesh;
  one.points.push_back({1e8, 0, 0});
  const Reconstruction with = reconstruct(std::move(one));
  EXPECT_EQ(with.report.outliers, 1U);
  EXPECT_NEAR(with.report.volume, 4 * std::numbers::pi / 3, 0.03);
  EXPECT_EQ(with.mesh.vertices, expected.vertices);
}

TEST_OF_TWO_SIZES(Reconstruct, wrong_normals_among_good_ones_do_no_harm) {
  const std::size_t n = nightly ? 10000 : 4000;
  PointCloud cloud = sphere_points(n);
  for (std::size_t i = 0; i < n; i += 10) cloud.normals[i] = random_direction(9, i);
  const Reconstruction made = reconstruct(std::move(cloud));
  EXPECT_EQ(expect_closed_manifold(made.mesh).euler_characteristic, 2);
  EXPECT_GT(made.report.outliers, n / 20);
  EXPECT_LT(made.report.outliers, n * 11 / 100);
  for (const Vec3& v : made.mesh.vertices) EXPECT_NEAR(norm(v), 1, 0.02);
}

TEST_OF_TWO_SIZES(Reconstruct, points_in_rows_make_the_surface_of_even_ones) {
  const std::size_t n = nightly ? 20000 : 6000;
  const Mesh ring = torus(2, 0.7, 400, 200);
  for (const double ratio : nightly ? std::vector{5.0, 20.0} : std::vector{5.0}) {
    for (const bool normals : nightly ? std::vector{true, false} : std::vector{true}) {
      const PointCloud rows = sample_surface(ring, {.points = n,
                                                    .pattern = SamplePattern::kRings,
                                                    .pattern_ratio = ratio,
                                                    .normals = normals});
      const Reconstruction made = reconstruct(rows);
      EXPECT_EQ(expect_closed_manifold(made.mesh).euler_characteristic, 0);
      // The bound is 0.1 times gap^2 times curvature; the best possible factor is about 0.01.
      const double gap =
          std::sqrt(ratio * 4 * std::numbers::pi * std::numbers::pi * 1.4 / static_cast<double>(n));
      for (const Vec3& v : made.mesh.vertices) {
        const double off = std::hypot(std::hypot(v.x, v.y) - 2, v.z) - 0.7;
        EXPECT_LT(std::abs(off), 0.1 * gap * gap / 0.7) << ratio << normals;
      }
    }
  }
}

TEST(Reconstruct, points_that_say_nothing_change_nothing) {
  const PointCloud clean = sphere_points(2000);
  const Mesh expected = reconstruct(clean).mesh;
  PointCloud cloud = clean;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  cloud.points.insert(cloud.points.end(), {{nan, 0, 0}, {0, HUGE_VAL, 0}, clean.points[3]});
  cloud.normals.insert(cloud.normals.end(), {{1, 0, 0}, {0, 1, 0}, clean.normals[3]});
  cloud.points.push_back({0, 0, 0});
  cloud.normals.push_back({0, 0, 0});
  const Reconstruction made = reconstruct(std::move(cloud));
  EXPECT_EQ(made.report.points, 2004U);
  EXPECT_EQ(made.report.dropped_points, 4U);
  EXPECT_EQ(made.mesh.vertices, expected.vertices);
  EXPECT_EQ(made.mesh.faces, expected.faces);
}

TEST_OF_TWO_SIZES(Reconstruct, uneven_density_does_not_tear_the_surface) {
  // The density is thirty times higher at one pole than at the other.
  PointCloud cloud;
  for (std::uint64_t i = 0; cloud.points.size() < (nightly ? 20000 : 8000); ++i) {
    const Vec3 u = random_direction(3, i);
    if (random_in(0, 1, 4, i) < std::pow(30, (u.z - 1) / 2)) cloud.points.push_back(u);
  }
  cloud.normals = cloud.points;
  const Reconstruction made = reconstruct(std::move(cloud));
  EXPECT_EQ(expect_closed_manifold(made.mesh).euler_characteristic, 2);
  const double bound = std::pow(largest_support(made.model.atlas), 4) / 8;
  for (const Vec3& v : made.mesh.vertices) EXPECT_NEAR(norm(v), 1, bound);
}

// ---- Attributes ----

TEST_OF_TWO_SIZES(Reconstruct, a_density_that_falls_a_thousand_times_does_not_tear_it_either) {
  // Points are drawn by rejection: the density is 1000^(-(z + 1) / 2).
  PointCloud cloud;
  for (std::uint64_t i = 0; cloud.points.size() < (nightly ? 20000 : 8000); ++i) {
    const Vec3 p = random_direction(3, i);
    if (random_in(0, 1, 4, i) < std::pow(1000, -(p.z + 1) / 2)) cloud.points.push_back(p);
  }
  cloud.normals = cloud.points;
  const Mesh mesh = reconstruct(std::move(cloud)).mesh;
  const Inspection found = inspect(mesh);
  EXPECT_TRUE(found.closed && found.manifold);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(found.genus, 0U);
  EXPECT_NEAR(found.volume, 4 * std::numbers::pi / 3, 0.02);
}

TEST(Reconstruct, caps_of_sparse_parts_agree_within_a_band_of_their_own) {
  // Spacings differ by a factor of 17. The step is the spacing of the dense end; bands in steps
  // alone would leave five handles at the other end.
  const Mesh ring = torus(2, 0.7, 400, 200);
  const Reconstruction made =
      reconstruct(sample_surface(ring, {.points = 20000, .density_ratio = 300}));
  EXPECT_EQ(expect_closed_manifold(made.mesh).euler_characteristic, 0);
  for (const Vec3& v : made.mesh.vertices) {
    // Points at that end are about 0.2 apart.
    EXPECT_NEAR(std::hypot(std::hypot(v.x, v.y) - 2, v.z), 0.7, 0.05);
  }
}

TEST(Reconstruct, attributes_that_are_linear_in_space_travel_along) {
  PointCloud cloud = sphere_points(5000);
  Attribute height{"height", ScalarType::kFloat32, {}}, red{"red", ScalarType::kUint8, {}};
  for (const Vec3& p : cloud.points) {
    height.values.push_back(2 * p.x - p.y + 3 * p.z);
    red.values.push_back(std::round(127.5 * (1 + p.z)));
  }
  cloud.attributes = {height, red};
  const Reconstruction made = reconstruct(std::move(cloud));
  const Attribute* const heights = find_attribute(made.mesh.attributes, "height");
  const Attribute* const reds = find_attribute(made.mesh.attributes, "red");
  ASSERT_NE(heights, nullptr);
  ASSERT_NE(reds, nullptr);
  EXPECT_EQ(reds->type, ScalarType::kUint8);
  EXPECT_EQ(heights->type, ScalarType::kFloat32);
  // The eight nearest points lie within 2.5 spacings (8 points fill pi r^2 with r = 1.6; holes
  // between random points need more). A mean of their values is off by at most the gradient times
  // that.
  const double reach = 2.5 * made.report.spacing;
  for (std::size_t i = 0; i < made.mesh.vertices.size(); ++i) {
    const Vec3& v = made.mesh.vertices[i];
    EXPECT_NEAR(heights->values[i], 2 * v.x - v.y + 3 * v.z, std::sqrt(14.0) * reach);
    EXPECT_NEAR(reds->values[i], 127.5 * (1 + v.z), 127.5 * reach + 1);
    EXPECT_EQ(reds->values[i], std::round(reds->values[i]));
    EXPECT_EQ(heights->values[i], static_cast<float>(heights->values[i]));
  }
}

TEST(Reconstruct, attributes_without_a_value_leave_it_to_their_neighbours) {
  PointCloud cloud = sphere_points(2000);
  Attribute heat{"heat", ScalarType::kFloat64, std::vector<double>(2000, 7)}, cold = heat;
  for (std::size_t i = 0; i < 2000; i += 100) {
    heat.values[i] = std::numeric_limits<double>::quiet_NaN();
    heat.values[i + 1] = std::numeric_limits<double>::infinity();
  }
  cold.name = "cold";
  cold.values.assign(2000, std::numeric_limits<double>::quiet_NaN());
  cloud.attributes = {heat, cold};
  const Reconstruction made = reconstruct(std::move(cloud));
  for (const double value : find_attribute(made.mesh.attributes, "heat")->values) {
    EXPECT_NEAR(value, 7, 1e-14);
  }
  for (const double value : find_attribute(made.mesh.attributes, "cold")->values) {
    EXPECT_TRUE(std::isnan(value));
  }
}

// ---- Contracts ----

TEST(Reconstruct, results_are_the_same_bits_for_every_number_of_threads) {
  PointCloud cloud = open_sphere(6000, 0.7);
  for (std::size_t i = 0; i < 100; ++i) {
    cloud.points.push_back(0.7 * random_direction(5, i));
    cloud.normals.push_back(random_direction(6, i));
  }
  cloud.attributes = {{"x", ScalarType::kFloat64, std::vector<double>(cloud.points.size())}};
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    cloud.attributes[0].values[i] = cloud.points[i].x;
  }
  const Reconstruction one = reconstruct(cloud, {}, {.threads = 1});
  const Reconstruction two = reconstruct(cloud, {}, {.threads = 2});
  EXPECT_EQ(one.mesh.vertices, two.mesh.vertices);
  EXPECT_EQ(one.mesh.faces, two.mesh.faces);
  EXPECT_EQ(one.model.atlas.coefficients, two.model.atlas.coefficients);
  ASSERT_EQ(one.mesh.attributes.size(), two.mesh.attributes.size());
  for (std::size_t a = 0; a < one.mesh.attributes.size(); ++a) {
    EXPECT_EQ(one.mesh.attributes[a].values, two.mesh.attributes[a].values);
  }
}

// Returns the rms distance from the truth to the surface of the moved points, moved back.
double error_after(const test::Motion& motion, std::size_t n_points) {
  static const Mesh truth = bumpy_sphere(5);
  PointCloud cloud = sample_surface(truth, {.points = n_points});
  test::Motion turn = motion;
  turn.scale = 1, turn.shift = {};
  for (Vec3& p : cloud.points) p = motion(p);
  for (Vec3& n : cloud.normals) n = turn(n);
  const Mesh mesh = reconstruct(std::move(cloud)).mesh;
  EXPECT_EQ(expect_closed_manifold(mesh).euler_characteristic, 2);
  std::vector<Vec3> some;
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 4) some.push_back(mesh.vertices[i]);
  return rms(distances_to_surface(some, test::moved(truth, motion))) / motion.scale;
}

TEST(Reconstruct, place_and_size_do_not_matter) {
  const double expected = error_after({}, 2000);
  for (const double scale : {1e-6, 1e6}) {
    test::Motion motion;
    motion.scale = scale;
    EXPECT_NEAR(error_after(motion, 2000) / expected, 1, 0.03) << scale;
  }
  test::Motion motion;
  motion.shift = {3e4, -2e4, 1e4};  // the diagonal is 3.5 at most
  EXPECT_NEAR(error_after(motion, 2000) / expected, 1, 0.03);
}

TEST(Reconstruct, direction_does_not_matter) {
  // Other points become seeds: the error belongs to about five hundred other caps, and its square
  // scatters by twice 1 / sqrt(500). With the same caps it would be exact to rounding, as above.
  const double expected = error_after({}, 5000);
  for (const double angle : {0.7, 2.0}) {
    EXPECT_NEAR(error_after(test::rotation({1, 2, 3}, angle), 5000) / expected, 1, 0.1);
  }
}

TEST(Reconstruct, stops_when_asked) {
  for (const char* stage : {"isolated points", "caps", "surface"}) {
    bool seen = false;
    const Context context{.progress = [&](std::string_view name, double) {
      const bool now = name.starts_with(stage);  // the time that is left may follow
      seen = seen || now;
      return !now;
    }};
    try {
      reconstruct(sphere_points(5000), {}, context);
      FAIL() << stage;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCancelled);
    }
    EXPECT_TRUE(seen) << stage;
  }
}

TEST(Reconstruct, more_memory_than_allowed_is_refused_with_the_number) {
  const std::string said =
      refusal(sphere_points(2000), {.step = 8e-3, .max_memory = 1 << 22}, ErrorCode::kOutOfMemory);
  EXPECT_NE(said.find("4 MiB"), std::string::npos) << said;
  // The error names a step that suffices, and that step works.
  const std::size_t at = said.find("take steps of ");
  ASSERT_NE(at, std::string::npos) << said;
  const double step = std::stod(said.substr(at + 14));
  EXPECT_GT(step, 8e-3);
  const Reconstruction made =
      reconstruct(sphere_points(2000), {.step = step, .max_memory = 1 << 22});
  EXPECT_LE(made.report.memory, std::size_t{1} << 22);
  EXPECT_EQ(made.report.step, step);
  // No step is suggested, because none suffices.
  EXPECT_NE(refusal(sphere_points(2000), {.step = 1e-300}, ErrorCode::kOutOfMemory), "");
  EXPECT_NE(refusal(sphere_points(2000), {.max_memory = 0}, ErrorCode::kOutOfMemory), "");
}

TEST(Reconstruct, options_out_of_range_are_refused_with_their_value) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {-1.0, nan, HUGE_VAL}) {
    for (const ReconstructOptions& options :
         {ReconstructOptions{.step = bad}, ReconstructOptions{.tolerance = bad},
          ReconstructOptions{.noise = bad}, ReconstructOptions{.min_component = bad}}) {
      const std::string said = refusal(sphere_points(100), options);
      EXPECT_NE(said.find(std::isnan(bad) ? "nan"
                          : bad < 0       ? "-1"
                                          : "inf"),
                std::string::npos)
          << said;
    }
  }
  EXPECT_NE(refusal(sphere_points(100), {.sensor = Vec3{0, nan, 0}}), "");
  EXPECT_THROW(parse_name<HolePolicy>("shut"), Error);
  EXPECT_EQ(parse_name<HolePolicy>(to_string(HolePolicy::kKeep)), HolePolicy::kKeep);
  EXPECT_EQ(parse_name<HolePolicy>(to_string(HolePolicy::kFill)), HolePolicy::kFill);
}

TEST(Reconstruct, arrays_that_do_not_fit_are_refused) {
  PointCloud cloud = sphere_points(100);
  cloud.normals.pop_back();
  EXPECT_NE(refusal(cloud), "");
  cloud = sphere_points(100);
  cloud.attributes = {{"a", ScalarType::kFloat32, {1, 2, 3}}};
  EXPECT_NE(refusal(cloud), "");
}

}  // namespace
}  // namespace rholm
