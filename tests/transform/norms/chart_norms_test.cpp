// The error predicted from the edges alone, compared with the true error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rholm/primitives.h"
#include "rholm/transform.h"
#include "support/oracle.h"
#include "support/sizes.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;

// A cube of edge 2 about 0: s_e = sqrt(2) on its twelve edges and 0 on the diagonals of its faces.
// At a vertex, seen along its axis, r^2 = 3.
TEST(vertex_error_strength, of_a_cube_is_the_sum_of_three_edges) {
  const StarChart chart = test::chart_about(box({2, 2, 2}), {});
  EXPECT_NEAR(vertex_error_strength(chart, RadialFunction::kRadius), 9 * std::sqrt(2.0), 1e-13);
  EXPECT_NEAR(vertex_error_strength(chart, RadialFunction::kGauge), 3 * std::sqrt(2.0), 1e-13);
  EXPECT_NEAR(vertex_error_strengths(view_of(chart.mesh), {}).distance, 9 * std::sqrt(2.0), 1e-13);
}

// int r^4 ds over an edge, x = (1, 1, z), is int (2 + z^2) sqrt(2) dz = 14/3 sqrt(2).
TEST(tail_strength, of_a_cube_is_that_of_its_twelve_edges) {
  const StarChart chart = test::chart_about(box({2, 2, 2}), {});
  const double expected = 12 * 2 * 14 / 3.0 * std::sqrt(2.0);
  EXPECT_NEAR(tail_strength(chart, RadialFunction::kRadius), expected, 1e-12);
  EXPECT_NEAR(tail_strength(view_of(chart.mesh), {}), expected, 1e-12);
}

TEST(chart_norms, seams_count_as_welded) {
  const Mesh mesh = bumpy_sphere(3, 0.3), soup = test::exploded(mesh);
  const Vec3 center = {0.1, 0.05, 0};
  const ErrorStrengths a = vertex_error_strengths(view_of(mesh), center);
  const ErrorStrengths b = vertex_error_strengths(view_of(soup), center);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.gauge, b.gauge);
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_EQ(tail_strength(view_of(mesh), center), tail_strength(view_of(soup), center));
}

TEST(chart_norms, have_units) {
  const Mesh mesh = bumpy_sphere(2, 0.3);
  const Mesh larger = test::moved(mesh, {.scale = 8, .shift = {}});
  const ErrorStrengths a = vertex_error_strengths(view_of(mesh), {});
  const ErrorStrengths b = vertex_error_strengths(view_of(larger), {});
  EXPECT_EQ(b.radius, 8 * a.radius);
  EXPECT_EQ(b.gauge, a.gauge / 8);
  EXPECT_EQ(b.distance, 8 * a.distance);
  EXPECT_EQ(tail_strength(view_of(larger), {}), 64 * tail_strength(view_of(mesh), {}));
}

struct Shape {
  const char* name;
  Mesh mesh;
  Vec3 center;
};

std::vector<Shape> coarse_shapes() {
  return {{"octahedron", test::rotated(test::random_octahedron(7)), {}},
          {"cube", test::rotated(box({2, 2, 2})), {}},
          {"box", test::rotated(box({2, 1, 3})), {0.1, 0.05, -0.2}},
          {"20 faces", test::rotated(bumpy_sphere(0, 0.3)), {0.1, 0.05, -0.2}},
          {"80 faces", test::rotated(bumpy_sphere(1, 0.3)), {0.1, 0.05, 0}}};
}

double largest_error_at_vertices(const StarChart& chart, const Expansion& expansion) {
  std::vector<Vec3> directions;
  directions.reserve(chart.mesh.vertices.size());
  for (const Vec3& v : chart.mesh.vertices) directions.push_back(v / norm(v));
  const std::vector<double> values =
      evaluate(expansion.coefficients, directions, {.engine = Engine::kDirect});
  double largest = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double truth = test::value_at(chart.mesh.vertices[i], expansion.function);
    largest = std::max(largest, std::abs(values[i] - truth));
  }
  return largest;
}

// Measured ratios: 0.96 ... 1.08 at L = 64, 0.99 ... 1.04 at 256.
TEST_OF_TWO_SIZES(vertex_error_strength, predicts_the_largest_error_at_vertices) {
  for (const Shape& shape : coarse_shapes()) {
    const StarChart chart = test::chart_about(shape.mesh, shape.center);
    for (const Method method : {Method::kEdge, Method::kGauge}) {
      for (const int L : nightly ? std::vector{64, 128, 256} : std::vector{64}) {
        const Transform a = expand(chart, {.degree = L, .method = method, .precision = 1e-10});
        const double predicted =
            vertex_error_strength(chart, a.expansion.function) / (2 * kPi * (L + 1));
        const double measured = largest_error_at_vertices(chart, a.expansion);
        EXPECT_NEAR(predicted / measured, 1, 0.1) << shape.name << " " << to_string(method) << L;
      }
    }
  }
}

// The truncation error is exact by Parseval; measured ratios: 0.98 ... 1.10.
TEST(tail_strength, predicts_the_truncation_error_of_coarse_meshes) {
  for (const Shape& shape : coarse_shapes()) {
    const StarChart chart = test::chart_about(shape.mesh, shape.center);
    for (const Method method : {Method::kEdge, Method::kGauge}) {
      for (const int L : {32, 64, 128}) {
        const Transform a = expand(chart, {.degree = L, .method = method, .precision = 1e-10});
        const double predicted =
            tail_strength(chart, a.expansion.function) / (3 * kPi * std::pow(L + 1, 3));
        EXPECT_NEAR(predicted / (4 * kPi * std::pow(*a.truncation_rms, 2)), 1, 0.15)
            << shape.name << " " << to_string(method) << L;
      }
    }
  }
}

}  // namespace
}  // namespace rholm
