#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rholm/error.h"
#include "rholm/transform.h"
#include "support/oracle.h"
#include "support/random_data.h"
#include "support/sizes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

using test::chart_about;
using test::oracle_coefficients;
using test::relative_error;

constexpr std::array kMethods = {Method::kEdge, Method::kGauge, Method::kCurl, Method::kArea};

RadialFunction function_of(Method method) {
  return method == Method::kGauge ? RadialFunction::kGauge : RadialFunction::kRadius;
}

// Returns the error of c_00 relative to c_00 itself.
double mean_error(const Coefficients& a, const Coefficients& b) {
  return std::abs(a.c(0, 0) / b.c(0, 0) - 1);
}

void expect_all_methods(const StarChart& chart, int degree, int oracle_nodes) {
  for (const Method method : kMethods) {
    const Coefficients expected =
        oracle_coefficients(chart.mesh, degree, function_of(method), oracle_nodes);
    const Transform transform =
        expand(chart, {.degree = degree, .method = method, .precision = 1e-13});
    const Coefficients& c = transform.expansion.coefficients;
    EXPECT_LT(relative_error(c, expected), 1e-11) << to_string(method);
    EXPECT_LT(mean_error(c, expected), 1e-11) << to_string(method);
    EXPECT_LT(transform.closure_residual, 1e-13);
  }
}

TEST(expand_chart, all_methods_agree_with_cubature_on_a_rotated_bumpy_sphere_off_centre) {
  const Mesh mesh = test::rotated(bumpy_sphere(2, 0.2));
  ASSERT_EQ(mesh.faces.size(), 320u);
  expect_all_methods(chart_about(mesh, {0.1, -0.2, 0.15}), 16, 20);
}

TEST(expand_chart, all_methods_agree_with_cubature_on_an_octahedron_with_edges_through_the_poles) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    expect_all_methods(chart_about(test::random_octahedron(seed), {0, 0, 0}), 16, 60);
  }
}

// The pole lies inside a face, on an edge, and within 1e-6 of an edge.
TEST(expand_chart, poles_may_lie_anywhere_on_the_mesh) {
  Mesh mesh = box({2, 2, 2});
  expect_all_methods(chart_about(mesh, {0.1, 0.05, 0}), 12, 60);
  expect_all_methods(chart_about(mesh, {0, 0, 0}), 12, 60);         // on a diagonal
  expect_all_methods(chart_about(mesh, {1e-6, -2e-6, 0}), 12, 60);  // next to it
}

TEST(expand_chart, a_face_seen_at_a_grazing_angle_keeps_its_digits) {
  // The centre is moved towards a face: d_T / r of the face falls to 0.07.
  const Mesh mesh = box({2, 2, 2}, 2);
  const StarChart chart = chart_about(mesh, {0.9, 0.3, -0.2});
  const Coefficients expected = oracle_coefficients(chart.mesh, 12, RadialFunction::kRadius, 250);
  for (const Method method : {Method::kEdge, Method::kArea}) {
    const Transform transform = expand(chart, {.degree = 12, .method = method, .precision = 1e-12});
    EXPECT_LT(relative_error(transform.expansion.coefficients, expected), 1e-11)
        << to_string(method);
  }
}

// A surface that is not star-shaped: a box whose top has a step. The wall of the step lies in a
// plane through the centre (d_T = 0), and one triangle of the side y = 1 is folded back over its
// neighbours (d_T < 0). All methods give the alternating sum.
TEST(expand_chart, faces_seen_edge_on_or_from_behind_enter_the_alternating_sum) {
  // The top is at z = 1 for x < 0 and at z = 0.5 for x > 0.
  Mesh mesh;
  mesh.vertices = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {0, -1, 1},
                   {0, 1, 1},    {-1, 1, 1},  {0, -1, .5}, {1, -1, .5}, {1, 1, .5},  {0, 1, .5}};
  mesh.faces = {{0, 2, 1},  {0, 3, 2}, {4, 5, 6}, {4, 6, 7},  {8, 9, 10}, {8, 10, 11}, {5, 8, 11},
                {5, 11, 6}, {0, 4, 7}, {0, 7, 3}, {1, 2, 10}, {1, 10, 9}, {0, 1, 9},   {0, 9, 8},
                {0, 8, 5},  {0, 5, 4}, {2, 3, 7}, {2, 7, 6},  {2, 6, 11}, {2, 11, 10}};
  ChartOptions options{.center = {.kind = CenterKind::kNone, .rays = 0}, .allow_signed = true};
  const StarChart chart = make_star_chart(mesh, options);
  EXPECT_FALSE(chart.report.star_shaped);
  const Coefficients expected = oracle_coefficients(chart.mesh, 16, RadialFunction::kRadius, 80);
  for (const Method method : {Method::kEdge, Method::kCurl, Method::kArea}) {
    const Transform transform = expand(chart, {.degree = 16, .method = method, .precision = 1e-12});
    EXPECT_LT(relative_error(transform.expansion.coefficients, expected), 1e-11)
        << to_string(method);
    EXPECT_FALSE(transform.truncation_rms.has_value());
  }
  EXPECT_THROW(expand(chart, {.degree = 4, .method = Method::kGauge}), Error);
}

// Compares nine of the 257 orders: their share of the error against the norm of all coefficients.
TEST_OF_TWO_SIZES(expand_chart, edge_and_gauge_agree_with_cubature_at_degree_256_on_a_coarse_mesh) {
  const StarChart chart = chart_about(test::random_octahedron(4), {0, 0, 0});
  std::vector orders = {1, 128, 256};
  if (nightly) orders = {0, 1, 2, 3, 50, 128, 200, 255, 256};
  for (const Method method : {Method::kEdge, Method::kGauge}) {
    const Transform transform =
        expand(chart, {.degree = 256, .method = method, .precision = 1e-12});
    const Coefficients& c = transform.expansion.coefficients;
    double difference = 0;
    for (const int m : orders) {
      Coefficients expected(256);
      test::add_oracle_order(chart.mesh, m, function_of(method), 180, expected);
      for (int l = std::max(m, 1); l <= 256; ++l) {
        difference += std::pow(c.c(l, m) - expected.c(l, m), 2);
        difference += std::pow(c.s(l, m) - expected.s(l, m), 2);
      }
    }
    const double norm_squared = *transform.expansion.norm_squared - std::pow(c.c(0, 0), 2);
    const double share = static_cast<double>(orders.size()) / 257;
    EXPECT_LT(std::sqrt(difference / norm_squared / share), 1e-11) << to_string(method);
  }
}

// The error never exceeds the requested precision plus the rounding of c_00.
TEST_OF_TWO_SIZES(expand_chart, wanted_precision_is_kept_from_1e_3_to_1e_12) {
  const Mesh bumpy = test::rotated(bumpy_sphere(1, 0.25));
  const struct {
    const char* name;
    StarChart chart;
    int degree, oracle_nodes;
  } cases[] = {{"bumpy", chart_about(bumpy, {0.1, 0, -0.1}), 30, 24},
               {"octahedron", chart_about(test::random_octahedron(5), {0, 0, 0}), 40, 80},
               {"fine sphere", chart_about(icosphere(nightly ? 3 : 2), {0.3, 0.1, 0}), 24,
                nightly ? 12 : 24}};
  for (const auto& [name, chart, degree, oracle_nodes] : cases) {
    for (const Method method : kMethods) {
      const Coefficients expected =
          oracle_coefficients(chart.mesh, degree, function_of(method), oracle_nodes);
      std::size_t last_nodes = 0;
      for (double precision = 1e-3; precision > 0.5e-12; precision /= nightly ? 10 : 1000) {
        const Transform transform =
            expand(chart, {.degree = degree, .method = method, .precision = precision});
        EXPECT_LT(relative_error(transform.expansion.coefficients, expected), precision + 1e-13)
            << name << " " << to_string(method) << " " << precision;
        EXPECT_LT(mean_error(transform.expansion.coefficients, expected), precision + 1e-14);
        const std::size_t nodes = transform.edge_nodes + transform.face_nodes;
        EXPECT_GE(nodes, last_nodes);
        last_nodes = nodes;
      }
    }
  }
}

TEST(expand_chart, gives_the_same_bits_for_any_number_of_threads) {
  const StarChart chart = chart_about(bumpy_sphere(2), {0.1, 0, 0});
  for (const Method method : kMethods) {
    const Transform one = expand(chart, {.degree = 20, .method = method}, {.threads = 1});
    for (const int threads : {2, 4}) {
      const Transform more = expand(chart, {.degree = 20, .method = method}, {.threads = threads});
      EXPECT_TRUE(std::equal(one.expansion.coefficients.values().begin(),
                             one.expansion.coefficients.values().end(),
                             more.expansion.coefficients.values().begin()));
    }
  }
}

TEST(expand_chart, scales_exactly_with_powers_of_two) {
  const Mesh mesh = bumpy_sphere(1);
  const StarChart chart = chart_about(mesh, {0, 0, 0});
  for (const double scale : {0x1p-300, 0x1p-20, 0x1p300}) {
    Mesh scaled = mesh;
    for (Vec3& v : scaled.vertices) v *= scale;
    const StarChart large = chart_about(scaled, {0, 0, 0});
    for (const Method method : kMethods) {
      const Transform a = expand(chart, {.degree = 8, .method = method});
      const Transform b = expand(large, {.degree = 8, .method = method});
      const double factor = method == Method::kGauge ? 1 / scale : scale;
      for (std::size_t i = 0; i < a.expansion.coefficients.values().size(); ++i) {
        EXPECT_EQ(a.expansion.coefficients.values()[i] * factor,
                  b.expansion.coefficients.values()[i]);
      }
    }
  }
}

TEST(expand_chart, refuses_sizes_beyond_what_squares_can_hold) {
  for (const double scale : {1e-310, 1e-200, 1e200}) {
    Mesh mesh = bumpy_sphere(1);
    for (Vec3& v : mesh.vertices) v *= scale;
    for (const Method method : kMethods) {
      EXPECT_THROW(expand(chart_about(mesh, {0, 0, 0}), {.degree = 3, .method = method}), Error);
    }
  }
}

TEST(expand_chart, degree_zero_is_the_mean) {
  const StarChart chart = chart_about(box({2, 2, 2}), {0, 0, 0});
  for (const Method method : kMethods) {
    const Coefficients expected = oracle_coefficients(chart.mesh, 0, function_of(method), 60);
    const Transform transform = expand(chart, {.degree = 0, .method = method, .precision = 1e-11});
    EXPECT_NEAR(transform.expansion.coefficients.c(0, 0), expected.c(0, 0),
                1e-10 * expected.c(0, 0))
        << to_string(method);
  }
}

TEST(expand_chart, refuses_degrees_precisions_and_centres_out_of_range) {
  const StarChart chart = chart_about(icosphere(0), {0, 0, 0});
  EXPECT_THROW(expand(chart, {.degree = -1}), Error);
  EXPECT_THROW(expand(chart, {.degree = kMaxDegree + 1}), Error);
  EXPECT_THROW(expand(chart, {.degree = 4, .precision = 0}), Error);
  EXPECT_THROW(expand(chart, {.degree = 4, .precision = NAN}), Error);
  EXPECT_THROW(parse_name<Method>("edges"), Error);
  ChartOptions on_a_vertex{.center = {.kind = CenterKind::kGiven, .point = {1, 1, 1}, .rays = 0},
                           .allow_signed = true};
  const StarChart bad = make_star_chart(box({2, 2, 2}), on_a_vertex);
  EXPECT_THROW(expand(bad, {.degree = 4}), Error);
}

TEST(expand_chart, can_be_cancelled) {
  const StarChart chart = chart_about(bumpy_sphere(3), {0, 0, 0});
  for (const Method method : kMethods) {
    int calls = 0;
    const Context context{.progress = [&](std::string_view, double) { return ++calls < 3; }};
    EXPECT_THROW(expand(chart, {.degree = 30, .method = method}, context), Error);
  }
}

}  // namespace
}  // namespace rholm
