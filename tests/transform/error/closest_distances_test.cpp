#include "transform/error/closest_distances.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rholm/primitives.h"
#include "rholm/star.h"
#include "rholm/transform.h"
#include "rholm/truncation.h"
#include "support/sizes.h"
#include "support/star_polyhedra.h"
#include "support/true_distance.h"
#include "transform/error/distance_check.h"
#include "transform/error/error_sites.h"

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;

Expansion sphere_of_radius(double r) {
  Expansion expansion;
  expansion.coefficients = Coefficients(0);
  expansion.coefficients.c(0, 0) = r * std::sqrt(4 * kPi);
  return expansion;
}

TEST(surface_pieces, add_up_to_the_area_and_to_the_sphere) {
  for (const double offset : {0.0, 0.9}) {
    const Mesh mesh = test::star_polyhedron(3, 0, offset, 5);
    double area = 0;
    for (const Triangle& t : mesh.faces) {
      const Vec3& a = mesh.vertices[t[0]];
      area += norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a)) / 2;
    }
    const SurfacePieces pieces = surface_pieces(view_of(mesh), {}, 5000);
    double areas = 0, angle = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const double part = pieces.areas[i] / (pieces.scale * pieces.scale);
      const double r = pieces.radii[i] / pieces.scale;
      areas += part;
      angle += part * pieces.cosines[i] / (r * r);
    }
    EXPECT_NEAR(areas, area, 1e-12 * area);
    // One point per piece: the error is of second order in sizes of 1/50.
    EXPECT_NEAR(angle, 4 * kPi, 0.01 * 4 * kPi);
    EXPECT_LT(pieces.size(), 10'000 + mesh.faces.size());
  }
}

TEST(surface_pieces, of_more_faces_than_points_are_taken_by_chance) {
  const Mesh mesh = bumpy_sphere(4, 0.3);
  const SurfacePieces pieces = surface_pieces(view_of(mesh), {0.2, 0, 0}, 1000);
  EXPECT_NEAR(static_cast<double>(pieces.size()), 1000, 50);
  double angle = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    angle += pieces.areas[i] * pieces.cosines[i] / (pieces.radii[i] * pieces.radii[i]);
  }
  EXPECT_NEAR(angle, 4 * kPi, 0.03 * 4 * kPi);
}

// A cube of edge 2, and the sphere of radius R about a centre off the cube's. A point x of the cube
// is
// R - |x|| from the sphere. Points of the sphere outside the cube are measured to its faces. The
// largest distance is at the farthest corner.
TEST(closest_distances, between_a_cube_and_a_sphere) {
  const Mesh cube = box({2, 2, 2});
  constexpr double kRadius = 1.3;
  const Vec3 center = {0.5, 0.2, -0.1};
  ClosestDistances distances(view_of(cube), center, 20'000);
  const FaceScan scan = scan_faces(view_of(cube), center, {});
  const ErrorPoints extreme = extreme_points(view_of(cube), center, scan, 0);
  const SurfaceDistances found =
      distances.measure(sphere_of_radius(kRadius), 0, extreme, 1e-10, {});
  EXPECT_NEAR(found.max, norm(Vec3{-1, -1, 1} - center) - kRadius, 1e-9);
  double there = 0, back = 0;
  const int n = 200;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double a = (2 * i + 1.0) / n - 1, b = (2 * j + 1.0) / n - 1;
      for (const Vec3& x : {Vec3{1, a, b}, Vec3{-1, a, b}, Vec3{a, 1, b}, Vec3{a, -1, b},
                            Vec3{a, b, 1}, Vec3{a, b, -1}}) {
        there += std::pow(norm(x - center) - kRadius, 2) / (6 * n * n);
      }
      // Points have equal areas of the sphere.
      const double z = a, phi = kPi * b, s = std::sqrt(1 - z * z);
      const Vec3 y = center + kRadius * Vec3{s * std::cos(phi), s * std::sin(phi), z};
      const Vec3 over = {std::max(std::abs(y.x) - 1, 0.0), std::max(std::abs(y.y) - 1, 0.0),
                         std::max(std::abs(y.z) - 1, 0.0)};
      const double inside = 1 - std::max({std::abs(y.x), std::abs(y.y), std::abs(y.z)});
      back += std::pow(inside > 0 ? inside : norm(over), 2) / (n * n);
    }
  }
  const double expected = std::sqrt(std::max(there, back));
  EXPECT_NEAR(found.rms, expected, 2e-3 * expected);
}

// Near a face seen at a small angle the first-order distance is far off; closest points are exact.
TEST_OF_TWO_SIZES(truncation_errors, distances_of_steep_polyhedra_are_those_of_closest_points) {
  for (const std::uint64_t seed : nightly ? std::vector{1, 2, 3} : std::vector{2}) {
    const Mesh mesh = test::star_polyhedron(seed - 1, 0, 0.9, seed);
    const StarChart chart =
        make_star_chart(mesh, {.center = {.kind = CenterKind::kNone, .point = {}, .rays = 0}});
    const Transform transform = expand(chart, {.degree = 12, .precision = 1e-10});
    const TruncationErrors errors = truncation_errors(view_of(mesh), transform.expansion);
    EXPECT_TRUE(errors.distances_are_closest);
    const test::TrueDistance truth =
        test::true_distance(mesh, transform.expansion.coefficients, 3000);
    const double noise = std::max(truth.there_error, truth.back_error);
    EXPECT_NEAR(*errors.distance_rms, truth.rms(), (0.003 + 4 * noise) * truth.rms()) << seed;
    EXPECT_NEAR(*errors.measured_max_distance, truth.max(), 0.01 * truth.max()) << seed;
  }
}

// The mesh has enough faces for a sample: bumps of half the radius, truncated at two degrees.
TEST_OF_TWO_SIZES(truncation_errors, distances_of_bumpy_meshes_are_those_of_closest_points) {
  const Mesh mesh = bumpy_sphere(4, 0.5, 3);
  const StarChart chart =
      make_star_chart(mesh, {.center = {.kind = CenterKind::kNone, .point = {}, .rays = 0}});
  for (const int degree : nightly ? std::vector{4, 8} : std::vector{4}) {
    const Transform transform = expand(chart, {.degree = degree, .precision = 1e-10});
    const TruncationErrors errors = truncation_errors(view_of(mesh), transform.expansion);
    EXPECT_TRUE(errors.distances_are_closest);
    const test::TrueDistance truth =
        test::true_distance(mesh, transform.expansion.coefficients, 2000);
    const double noise = std::max(truth.there_error, truth.back_error);
    EXPECT_NEAR(*errors.distance_rms, truth.rms(), (0.005 + 4 * noise) * truth.rms()) << degree;
    EXPECT_GT(*errors.measured_max_distance, 0.998 * truth.max()) << degree;
    EXPECT_LT(*errors.measured_max_distance, 1.03 * truth.max()) << degree;
  }
}

// The sizes of model and mesh are unrelated: no work is done beyond first order.
TEST(truncation_errors, of_sizes_that_do_not_compare_come_at_once) {
  for (const double size : {1e-100, 1e100}) {
    Mesh mesh = box({2, 2, 2});
    for (Vec3& v : mesh.vertices) v *= size;
    const TruncationErrors errors = truncation_errors(view_of(mesh), sphere_of_radius(1));
    EXPECT_FALSE(errors.distances_are_closest);
  }
}

TEST(expand_to_a_tolerance, of_the_distance_is_kept_on_steep_polyhedra_nightly) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Mesh mesh = test::star_polyhedron(2 * (seed - 1), 0, 0.9, seed);
    const StarChart chart =
        make_star_chart(mesh, {.center = {.kind = CenterKind::kNone, .point = {}, .rays = 0}});
    for (const ErrorNorm norm : {ErrorNorm::kRms, ErrorNorm::kMax}) {
      const ToleranceTransform found =
          expand(chart, Tolerance{.error = norm == ErrorNorm::kRms ? 0.01 : 0.06,
                                  .unit = ToleranceUnit::kDiagonal,
                                  .norm = norm,
                                  .measure = ErrorMeasure::kDistance,
                                  .max_degree = 48});
      if (!found.met) continue;
      const test::TrueDistance truth =
          test::true_distance(mesh, found.transform.expansion.coefficients, 2000);
      const double noise = std::max(truth.there_error, truth.back_error);
      if (norm == ErrorNorm::kRms) {
        EXPECT_LE(truth.rms(), found.allowed * (1.003 + 4 * noise)) << seed;
      } else {
        EXPECT_LE(truth.max(), 1.003 * found.allowed) << seed;
      }
    }
  }
}

}  // namespace
}  // namespace rholm
