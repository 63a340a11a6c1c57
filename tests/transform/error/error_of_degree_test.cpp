#include "transform/error/error_of_degree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rholm/analyze.h"
#include "rholm/primitives.h"
#include "rholm/star.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

// Energies are 1, 3 * 4, 5 * 9: every coefficient of degree l is l + 1.
Coefficients three_degrees() {
  Coefficients c(2);
  for (int l = 0; l <= 2; ++l) {
    for (int m = 0; m <= l; ++m) {
      c.c(l, m) = l + 1;
      if (m > 0) c.s(l, m) = l + 1;
    }
  }
  return c;
}

TEST(rms_tails, are_the_energies_of_higher_degrees_and_what_is_beyond) {
  const std::vector<double> tails = rms_tails(three_degrees(), 7);
  ASSERT_EQ(tails.size(), 3u);
  const double sphere = 4 * std::numbers::pi;
  EXPECT_DOUBLE_EQ(tails[2], std::sqrt(7 / sphere));
  EXPECT_DOUBLE_EQ(tails[1], std::sqrt((7 + 45) / sphere));
  EXPECT_DOUBLE_EQ(tails[0], std::sqrt((7 + 45 + 12) / sphere));
}

TEST(rms_tails, say_which_degree_is_the_smallest_within_a_limit) {
  const std::vector<double> tails = {3, 2, 1, 0.5};
  EXPECT_EQ(smallest_degree(tails, 5), 0);
  EXPECT_EQ(smallest_degree(tails, 2), 1);
  EXPECT_EQ(smallest_degree(tails, 1.9), 2);
  EXPECT_EQ(smallest_degree(tails, 0.1), 3);
}

// The error at low degrees of coarse coefficients equals the measured error of exact coefficients.
TEST(error_of_degree, is_that_of_the_model_of_this_degree) {
  const Mesh mesh = test::rotated(bumpy_sphere(3, 0.3));
  const StarChart chart =
      make_star_chart(mesh, {.center = {.kind = CenterKind::kNone, .point = {}, .rays = 0}});
  const Analysis coarse = analyze(chart, {.degree = 40, .precision = 1e-4});
  for (const ErrorNorm norm : {ErrorNorm::kRms, ErrorNorm::kMax}) {
    for (const ErrorMeasure measure : {ErrorMeasure::kRadius, ErrorMeasure::kDistance}) {
      // The error of this case is computed from energies.
      if (norm == ErrorNorm::kRms && measure == ErrorMeasure::kRadius) continue;
      const Tolerance tolerance{.error = 1e-3, .norm = norm, .measure = measure};
      const Context context;
      ErrorSites sites(view_of(mesh), {});
      ErrorOfDegree error(tolerance, sites, 1, context);
      for (const int degree : {40, 31, 17}) {
        const Analysis exact = analyze(chart, {.degree = degree, .precision = 1e-10});
        const double measured =
            error_in(truncation_errors(view_of(mesh), exact.expansion), tolerance);
        EXPECT_NEAR(error.of(coarse.expansion, degree, measured), measured, 0.01 * measured)
            << to_string(norm) << " " << to_string(measure) << " " << degree;
      }
    }
  }
}

TEST(error_of_degree, is_taken_from_a_part_of_the_points_away_from_the_limit) {
  const Mesh mesh = test::rotated(bumpy_sphere(5, 0.3));
  const StarChart chart =
      make_star_chart(mesh, {.center = {.kind = CenterKind::kNone, .point = {}, .rays = 0}});
  const Analysis coarse = analyze(chart, {.degree = 20, .precision = 1e-4});
  const Tolerance tolerance{.error = 1e-3, .measure = ErrorMeasure::kDistance};
  const Context context;
  ErrorSites sites(view_of(mesh), {});
  ErrorOfDegree error(tolerance, sites, 1, context);
  const auto of = [&](double limit) { return error.of(coarse.expansion, 4, limit); };
  const double near = of(1), part = of(2 * near), all = of(near);
  // Interpolation has an error of at most a thousandth of the limit.
  EXPECT_NEAR(of(0.5 * near), part, 1e-4 * part);
  EXPECT_NEAR(of(0.98 * near), all, 1e-4 * all);
  // Root mean squares over 20 000 and 100 000 points, with several points on each face.
  EXPECT_GT(std::abs(part - all), 3e-4 * all);
  EXPECT_NEAR(part, all, 0.03 * all);
}

}  // namespace
}  // namespace rholm
