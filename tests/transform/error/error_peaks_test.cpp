#include "transform/error/error_peaks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rholm/harmonic.h"
#include "rholm/primitives.h"
#include "rholm/star.h"
#include "rholm/transform.h"
#include "rholm/truncation.h"
#include "support/dense_error.h"
#include "support/sizes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

// Returns 320 faces, some of which are seen at a small angle.
Mesh rougher_sphere() {
  Mesh mesh = icosphere(2);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] *= test::random_in(0.6, 1.6, 3, i);
  }
  return mesh;
}

// A box with a pyramid-shaped pit in its top.
Mesh box_with_a_pit() {
  Mesh mesh;
  mesh.vertices = {{-.3, -.9, -.5}, {.3, -.9, -.5}, {.3, .9, -.5}, {-.3, .9, -.5},  {-.3, -.9, .5},
                   {.3, -.9, .5},   {.3, .9, .5},   {-.3, .9, .5}, {0.05, 0.1, 0.3}};
  mesh.faces = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7},
                {2, 7, 6}, {3, 0, 4}, {3, 4, 7}, {4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 4, 8}};
  return mesh;
}

// A single wave peaks in a direction inside one face, which is none of the points.
TEST(highest_peaks, are_found_between_points) {
  const Mesh mesh = icosphere(1);
  for (const Vec3& peak : {normalized(Vec3{0.3, 0.4, 0.7}), normalized(Vec3{-0.8, 0.1, 0.2})}) {
    constexpr int kDegree = 12;
    const ErrorAt error = [&](const ErrorPoints& at) {
      std::vector<double> values;
      values.reserve(at.directions.size());
      for (const Vec3& u : at.directions) {
        values.push_back(1 + std::cos(std::min(kDegree * norm(u - peak), 3.14)));
      }
      return values;
    };
    const FaceScan scan = scan_faces(view_of(mesh), Vec3{}, {});
    const ErrorPoints points = extreme_points(view_of(mesh), {}, scan, kDegree);
    const double found = highest_peaks(view_of(mesh), {}, points, {{error(points), error}}, kDegree,
                                       3, {.threads = 1})[0];
    EXPECT_GT(found, 0.999 * 2);
    EXPECT_LE(found, 2);
    EXPECT_LT(largest(error(points)), 0.99 * 2);
  }
}

StarChart chart_about_origin(const Mesh& mesh) {
  return make_star_chart(mesh, {.center = {.kind = CenterKind::kNone, .point = {}, .rays = 0}});
}

// Compares with 400 points on each face and climbs from the worst points. Faces are short or long
// compared with 1/L, or seen at a small angle.
TEST(truncation_errors, measured_max_is_that_of_dense_points_nightly) {
  for (const Mesh& mesh :
       {test::rotated(bumpy_sphere(2, 0.3)), test::random_octahedron(4),
        test::rotated(box({2, 1.6, 1.2})), test::rotated(box({2, 1.6, 0.1})), rougher_sphere()}) {
    const StarChart chart = chart_about_origin(mesh);
    for (const int degree : {5, 11, 23, 90}) {
      const Transform transform = expand(chart, {.degree = degree, .precision = 1e-9});
      const double dense =
          test::largest_error_of_dense_points(mesh, transform.expansion.coefficients, 28);
      const TruncationErrors errors = truncation_errors(view_of(mesh), transform.expansion);
      EXPECT_GT(*errors.measured_max, 0.9995 * dense) << mesh.faces.size() << ' ' << degree;
      EXPECT_LT(*errors.measured_max, 1.001 * dense) << mesh.faces.size() << ' ' << degree;
    }
  }
}

// Faces have lengths of 200/L: seven points on each, with climbs from there, find too little.
TEST_OF_TWO_SIZES(truncation_errors, measured_max_is_that_of_dense_points_on_long_faces) {
  const Mesh mesh = test::rotated(box_with_a_pit());
  const StarChart chart = chart_about_origin(mesh);
  for (const int degree : nightly ? std::vector{60, 180} : std::vector{60}) {
    const Expansion expansion = expand(chart, {.degree = degree, .precision = 1e-9}).expansion;
    const double dense = test::largest_error_of_dense_points(mesh, expansion.coefficients, 120);
    const TruncationErrors errors = truncation_errors(view_of(mesh), expansion);
    EXPECT_NEAR(*errors.measured_max, dense, 5e-4 * dense) << degree;
    EXPECT_GT(errors.points, static_cast<std::size_t>(10 * degree * degree));
  }
}

TEST(truncation_errors, are_the_same_bits_for_any_number_of_threads) {
  const Mesh mesh = rougher_sphere();
  const Expansion expansion = expand(chart_about_origin(mesh), {.degree = 60}).expansion;
  const TruncationErrors one = truncation_errors(view_of(mesh), expansion, {}, {.threads = 1});
  const TruncationErrors three = truncation_errors(view_of(mesh), expansion, {}, {.threads = 3});
  EXPECT_EQ(*one.measured_max, *three.measured_max);
  EXPECT_EQ(*one.measured_max_distance, *three.measured_max_distance);
  EXPECT_EQ(one.points, three.points);
}

}  // namespace
}  // namespace rholm
