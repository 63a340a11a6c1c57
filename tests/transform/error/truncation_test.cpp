#include "rholm/truncation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "rholm/error.h"
#include "rholm/harmonic.h"
#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "support/oracle.h"
#include "support/sizes.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

StarChart chart_of(const Mesh& mesh, const Vec3& center = {}) {
  return make_star_chart(mesh,
                         {.center = {.kind = CenterKind::kGiven, .point = center, .rays = 0}});
}

// Returns the root mean square of r - r_L over solid angle, by dense cubature.
double dense_rms(const Mesh& mesh, const Coefficients& c, int n) {
  std::vector<Vec3> directions;
  std::vector<double> radii, weights;
  test::visit_oracle_nodes(mesh, n, [&](const Vec3& x, double w) {
    radii.push_back(norm(x));
    directions.push_back(x / norm(x));
    weights.push_back(w);
  });
  const std::vector<double> model = evaluate(c, directions);
  double sum = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    sum += weights[i] * std::pow(radii[i] - model[i], 2);
  }
  return std::sqrt(sum / (4 * std::numbers::pi));
}

TEST(truncation_errors, exact_rms_is_that_of_dense_cubature) {
  for (const Mesh& mesh : {test::random_octahedron(5), box({2, 1.6, 1.2})}) {
    const StarChart chart = chart_of(mesh);
    for (const int degree : {8, 32}) {
      const Transform transform = expand(chart, {.degree = degree, .precision = 1e-14});
      const TruncationErrors errors =
          truncation_errors(view_of(mesh), transform.expansion, {.precision = 1e-14});
      ASSERT_TRUE(errors.rms_is_exact);
      const double dense = dense_rms(chart.mesh, transform.expansion.coefficients, 80);
      EXPECT_NEAR(*errors.rms, dense, 1e-6 * dense) << degree;
      EXPECT_NEAR(*transform.truncation_rms, dense, 1e-6 * dense) << degree;
    }
  }
}

TEST(truncation_errors, measured_rms_is_the_exact_one_to_a_hundredth) {
  const Mesh mesh = test::rotated(bumpy_sphere(3, 0.25));
  const StarChart chart = chart_of(mesh);
  Transform transform = expand(chart, {.degree = 20, .precision = 1e-12});
  const TruncationErrors exact =
      truncation_errors(view_of(mesh), transform.expansion, {.precision = 1e-12});
  ASSERT_TRUE(exact.rms_is_exact);
  // If coefficients are declared inaccurate, Parseval's difference has no meaning.
  const TruncationErrors measured =
      truncation_errors(view_of(mesh), transform.expansion, {.precision = 1e-3});
  EXPECT_FALSE(measured.rms_is_exact);
  EXPECT_NEAR(*measured.rms, *exact.rms, 0.01 * *exact.rms);
}

// The largest error of a box is at a corner, which is one of the points.
TEST(truncation_errors, the_largest_is_that_of_the_worst_vertex) {
  const Mesh mesh = test::random_octahedron(3);
  const StarChart chart = chart_of(mesh);
  const Transform transform = expand(chart, {.degree = 64, .precision = 1e-10});
  double worst = 0;
  for (const Vec3& x : chart.mesh.vertices) {
    const std::vector<Vec3> u = {x / norm(x)};
    worst = std::max(worst, std::abs(norm(x) - evaluate(transform.expansion.coefficients, u)[0]));
  }
  const TruncationErrors errors = truncation_errors(view_of(mesh), transform.expansion);
  EXPECT_NEAR(*errors.measured_max, worst, 1e-6 * worst);
  ASSERT_TRUE(errors.predicted_max.has_value());
  EXPECT_NEAR(*errors.predicted_max, worst, 0.1 * worst);
}

TEST(truncation_errors, of_the_gauge_are_radial_too) {
  const Mesh mesh = bumpy_sphere(3, 0.2);
  const StarChart chart = chart_of(mesh);
  const Transform radius = expand(chart, {.degree = 40});
  const Transform gauge = expand(chart, {.degree = 40, .method = Method::kGauge});
  const TruncationErrors a = truncation_errors(view_of(mesh), radius.expansion);
  const TruncationErrors b = truncation_errors(view_of(mesh), gauge.expansion);
  EXPECT_FALSE(b.rms_is_exact);
  EXPECT_NEAR(*b.rms, *a.rms, 0.5 * *a.rms);
  EXPECT_NEAR(*b.measured_max, *a.measured_max, 0.5 * *a.measured_max);
}

struct Case {
  Tolerance tolerance;
  const char* name;
};

std::vector<Case> cases() {
  return {{{.error = 0.03}, "rms of the radius"},
          {{.error = 0.01, .unit = ToleranceUnit::kRadius}, "rms, of the mean radius"},
          {{.error = 0.05, .norm = ErrorNorm::kMax}, "largest"},
          {{.error = 3e-3, .unit = ToleranceUnit::kDiagonal, .measure = ErrorMeasure::kDistance},
           "rms distance"},
          {{.error = 0.02,
            .unit = ToleranceUnit::kDiagonal,
            .norm = ErrorNorm::kMax,
            .measure = ErrorMeasure::kDistance},
           "largest distance"}};
}

double error_of(const Tolerance& tolerance, const TruncationErrors& errors) {
  if (tolerance.measure == ErrorMeasure::kRadius) {
    return tolerance.norm == ErrorNorm::kRms ? *errors.rms : *errors.measured_max;
  }
  return tolerance.norm == ErrorNorm::kRms ? *errors.distance_rms : *errors.measured_max_distance;
}

TEST_OF_TWO_SIZES(expand_to_a_tolerance, finds_the_smallest_degree_that_keeps_it) {
  std::vector<Mesh> meshes = {test::rotated(bumpy_sphere(3, 0.3))};
  if (nightly) meshes.push_back(box({2, 1.6, 1.2}));
  for (const Mesh& mesh : meshes) {
    const StarChart chart = chart_of(mesh);
    for (const Case& c : cases()) {
      const ToleranceTransform found = expand(chart, c.tolerance);
      ASSERT_TRUE(found.met) << c.name;
      EXPECT_LE(found.reached, found.allowed) << c.name;
      Expansion expansion = found.transform.expansion;
      const int degree = expansion.coefficients.degree();
      const auto measured = [&](int l) {
        Expansion cut = expansion;
        cut.coefficients = cut.coefficients.resized(l);
        return error_of(c.tolerance, truncation_errors(view_of(mesh), cut, {.precision = 1e-9}));
      };
      // Points between vertices are denser for the higher degree of the search.
      EXPECT_NEAR(measured(degree), found.reached, 0.03 * found.reached) << c.name;
      if (degree > 10) {
        EXPECT_GT(measured(degree - degree / 10), found.allowed) << c.name;
      }
    }
  }
}

TEST(expand_to_a_tolerance, says_when_the_largest_degree_is_not_enough) {
  const StarChart chart = chart_of(box({2, 1.6, 1.2}));
  const ToleranceTransform found = expand(chart, {.error = 1e-6, .max_degree = 20});
  EXPECT_FALSE(found.met);
  EXPECT_EQ(found.transform.expansion.coefficients.degree(), 20);
  EXPECT_GT(found.reached, 1e-6);
}

TEST(expand_to_a_tolerance, a_generous_one_needs_the_mean_alone) {
  const StarChart chart = chart_of(icosphere(3));
  EXPECT_EQ(expand(chart, {.error = 0.5}).transform.expansion.coefficients.degree(), 0);
}

TEST(expand_to_a_tolerance, gives_the_same_bits_for_any_number_of_threads) {
  const StarChart chart = chart_of(test::rotated(bumpy_sphere(3, 0.3)));
  const Tolerance tolerance{.error = 5e-3, .norm = ErrorNorm::kMax};
  const ToleranceTransform one = expand(chart, tolerance, {}, {.threads = 1});
  for (const int threads : {2, 4}) {
    const ToleranceTransform many = expand(chart, tolerance, {}, {.threads = threads});
    EXPECT_EQ(many.reached, one.reached);
    const auto a = one.transform.expansion.coefficients.values();
    const auto b = many.transform.expansion.coefficients.values();
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
  }
}

TEST(expand_to_a_tolerance, refuses_what_means_nothing) {
  const StarChart chart = chart_of(icosphere(1));
  EXPECT_THROW(expand(chart, Tolerance{.error = 0}), Error);
  EXPECT_THROW(expand(chart, Tolerance{.error = std::nan("")}), Error);
  EXPECT_THROW(expand(chart, Tolerance{.error = 1, .max_degree = -1}), Error);
  EXPECT_THROW(expand(chart, Tolerance{.error = 1}, {.method = Method::kGauge}), Error);
}

TEST(expand_to_a_tolerance, can_be_cancelled) {
  const StarChart chart = chart_of(bumpy_sphere(3));
  int calls = 0;
  const Context context{.progress = [&](std::string_view, double) { return ++calls < 3; }};
  try {
    expand(chart, Tolerance{.error = 1e-3, .norm = ErrorNorm::kMax}, {}, context);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

TEST(tolerance_names, are_read_as_they_are_written) {
  for (const ErrorNorm norm : {ErrorNorm::kRms, ErrorNorm::kMax}) {
    EXPECT_EQ(parse_name<ErrorNorm>(to_string(norm)), norm);
  }
  for (const ErrorMeasure measure : {ErrorMeasure::kRadius, ErrorMeasure::kDistance}) {
    EXPECT_EQ(parse_name<ErrorMeasure>(to_string(measure)), measure);
  }
  for (const ToleranceUnit unit :
       {ToleranceUnit::kAbsolute, ToleranceUnit::kDiagonal, ToleranceUnit::kRadius}) {
    EXPECT_EQ(parse_name<ToleranceUnit>(to_string(unit)), unit);
  }
  EXPECT_THROW(parse_name<ErrorNorm>("l1"), Error);
  EXPECT_THROW(parse_name<ErrorMeasure>("radius "), Error);
  EXPECT_THROW(parse_name<ToleranceUnit>(""), Error);
}

}  // namespace
}  // namespace rholm
