#include "transform/norms/parseval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rholm/analyze.h"
#include "rholm/primitives.h"
#include "rholm/rms_beyond.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

constexpr double kSphere = 4 * std::numbers::pi;

// Norms: 3 in c_00, 4 in the other coefficients, and 0.5 beyond them.
Coefficients known() {
  Coefficients c(2);
  c.c(0, 0) = 3;
  c.c(1, 0) = 2;
  c.s(2, 1) = -2;
  c.c(2, 2) = std::sqrt(8.0);
  return c;
}
constexpr double kBeyond = 0.5, kNorm = 9 + 16 + kBeyond;

TEST(parseval_rest, is_what_the_coefficients_leave_of_the_norm) {
  const ParsevalRest rest = parseval_rest(kNorm, known(), {});
  EXPECT_NEAR(rest.value, kBeyond, 1e-14);
  EXPECT_LT(rest.doubt, 1e-12);
  EXPECT_NEAR(*rms_of(rest, kBelieved), std::sqrt(kBeyond / kSphere), 1e-14);
}

// The worst errors are parallel to the coefficients: then the uncertainty equals the error of the
// remainder. It may differ by twice the squared error, because it is computed from the inexact
// norm.
TEST(parseval_rest, is_off_by_its_doubt_where_errors_are_worst) {
  for (const double relative : {-1e-2, -1e-6, 1e-6, 1e-2}) {
    Coefficients c = known();
    for (double& value : c.values()) value *= 1 + relative;
    const double size = std::abs(relative);
    const ParsevalRest rest = parseval_rest(kNorm, c, {.mean = 3 * size, .varying = 4 * size});
    const double off = std::abs(rest.value - kBeyond);
    EXPECT_LE(off, rest.doubt * (1 + 1e-9)) << relative;
    EXPECT_GE(off, rest.doubt * (1 - 3 * size)) << relative;
  }
}

TEST(parseval_rest, of_relative_errors_is_that_of_the_mean_and_the_rest) {
  const CoefficientErrors errors = coefficient_errors(kNorm, known(), 1e-3, 1e-5);
  EXPECT_DOUBLE_EQ(errors.mean, 3e-3);
  EXPECT_DOUBLE_EQ(errors.varying, 1e-5 * std::sqrt(16 + kBeyond));
}

TEST(rms_of, is_none_where_the_doubt_is_above_a_quarter) {
  EXPECT_FALSE(rms_of({.value = 1, .doubt = 0.26}, kBelieved));
  EXPECT_FALSE(rms_of({.value = -1, .doubt = 0.2}, kBelieved));
  EXPECT_FALSE(rms_of({.value = std::nan(""), .doubt = 0.2}, kBelieved));
  const ParsevalRest rest{.value = 1, .doubt = 0.25};
  ASSERT_TRUE(rms_of(rest, kBelieved));
  EXPECT_NEAR(rms_doubt(rest), (1 - std::sqrt(0.75)) / std::sqrt(kSphere), 1e-15);
}

// Degree 1 has 4, degree 2 has 12, and 0.5 lie beyond. The remainder is uncertain by `doubt`,
// through an exact error or through a measured error that differs by this amount.
Expansion known_expansion() {
  Expansion e;
  e.coefficients = known();
  e.norm_squared = kNorm;
  return e;
}

Expansion measured_expansion(double beyond) {
  Expansion e = known_expansion();
  e.errors.emplace().rms = std::sqrt(beyond / kSphere);
  return e;
}

TEST(rms_beyond, is_by_parseval_where_the_rest_is_four_times_its_doubt) {
  const RmsBeyond all = rms_beyond(measured_expansion(0.8 * kBeyond));
  ASSERT_EQ(all.rms.size(), 3U);
  EXPECT_NEAR(all.doubt.value(), 0.2 * kBeyond, 1e-14);
  EXPECT_NEAR(all.rms[0].value(), std::sqrt((16 + kBeyond) / kSphere), 1e-15);
  EXPECT_NEAR(all.rms[1].value(), std::sqrt((12 + kBeyond) / kSphere), 1e-15);
  EXPECT_NEAR(all.rms[2].value(), std::sqrt(kBeyond / kSphere), 1e-14);
  const RmsBeyond some = rms_beyond(measured_expansion(0.7 * kBeyond));
  EXPECT_TRUE(some.rms[1].has_value());
  EXPECT_FALSE(some.rms[2].has_value());
  EXPECT_NEAR(some.bound().value(), std::sqrt(5 * 0.3 * kBeyond / kSphere), 1e-14);
}

// Without measured errors the uncertainty follows from the default precision: 2 |c| |dc|.
TEST(rms_beyond, has_the_doubt_of_the_default_precision_or_of_an_exact_error) {
  Expansion e = known_expansion();
  const double varying = std::sqrt(16 + kBeyond);
  EXPECT_NEAR(rms_beyond(e).doubt.value(), 2e-8 * (9 + 4 * varying), 1e-11);
  e.norm_squared = 25 + 1e-7;  // four times the uncertainty is 2e-6
  EXPECT_FALSE(rms_beyond(e).rms[2].has_value());
  e.errors.emplace().rms = std::sqrt(1e-7 / kSphere);
  e.errors->rms_is_exact = true;  // from more accurate coefficients
  EXPECT_NEAR(rms_beyond(e).rms[2].value(), std::sqrt(1e-7 / kSphere), 1e-11);
}

TEST(rms_beyond, judges_by_the_precision_that_the_expansion_has) {
  Expansion e = known_expansion();
  EXPECT_TRUE(rms_beyond(e).precision_is_assumed);
  const double varying = std::sqrt(16 + kBeyond);
  for (const double precision : {1e-12, 1e-8, 1e-4, 1e-2}) {
    e.precision = precision;
    const RmsBeyond beyond = rms_beyond(e);
    EXPECT_EQ(beyond.precision, precision);
    EXPECT_FALSE(beyond.precision_is_assumed);
    EXPECT_NEAR(beyond.doubt.value(), 2 * precision * (9 + 4 * varying),
                26 * precision * precision + 1e-12);
    EXPECT_EQ(beyond.rms[2].has_value(), kBeyond >= 4 * beyond.doubt.value());
    EXPECT_EQ(beyond.is_exact(2), kBeyond >= 50 * beyond.doubt.value());
  }
  EXPECT_FALSE(rms_beyond(e).rms[2].has_value());
}

TEST(rms_beyond, is_not_known_without_a_norm_but_within_the_expansion) {
  Expansion e;
  e.coefficients = known();
  const RmsBeyond none = rms_beyond(e);
  for (const std::optional<double>& rms : none.rms) EXPECT_FALSE(rms.has_value());
  EXPECT_FALSE(none.bound().has_value());
  EXPECT_FALSE(none.degree_within(1e6).has_value());
  EXPECT_NEAR(none.rms_within[0], std::sqrt(16 / kSphere), 1e-15);
  EXPECT_NEAR(none.rms_within[1], std::sqrt(12 / kSphere), 1e-15);
  EXPECT_EQ(none.rms_within[2], 0);
}

// A tolerance counts as met by a known error or by the bound, and by nothing else.
TEST(rms_beyond, degree_within_a_tolerance_rests_on_what_is_known) {
  const double of_one = std::sqrt((12 + kBeyond) / kSphere);
  const RmsBeyond some = rms_beyond(measured_expansion(0.7 * kBeyond));
  EXPECT_EQ(some.degree_within(1.001 * of_one), 1);
  EXPECT_EQ(some.degree_within(0.999 * of_one), 2);
  EXPECT_EQ(some.degree_within(*some.bound()), 2);
  EXPECT_FALSE(some.degree_within(0.99 * *some.bound()).has_value());
}

// For any precision: no error is given, or it is within its uncertainty of the exact one.
TEST(truncation_rms, is_none_or_within_its_doubt) {
  int given = 0;
  for (const Mesh& mesh : {box({2, 1.6, 1.2}), test::rotated(bumpy_sphere(2, 0.3)),
                           test::rotated(icosphere(2)), test::random_octahedron(5)}) {
    const StarChart chart = make_star_chart(
        mesh, {.center = {.kind = CenterKind::kGiven, .point = {0.1, 0.05, 0}, .rays = 0}});
    for (const int degree : {0, 12, 32}) {
      const Analysis exact =
          analyze(chart, {.degree = degree, .engine = Engine::kDirect, .precision = 1e-14});
      ASSERT_TRUE(exact.truncation_rms);
      for (const Engine engine : {Engine::kFast, Engine::kDirect}) {
        for (const double precision : {1e-1, 1e-2, 1e-3, 1e-5, 1e-8}) {
          const Analysis coarse =
              analyze(chart, {.degree = degree, .engine = engine, .precision = precision});
          ASSERT_EQ(coarse.truncation_rms.has_value(), coarse.truncation_rms_doubt.has_value());
          if (!coarse.truncation_rms) continue;
          ++given;
          EXPECT_NEAR(*coarse.truncation_rms, *exact.truncation_rms, *coarse.truncation_rms_doubt)
              << degree << ' ' << to_string(engine) << ' ' << precision;
          EXPECT_LT(*coarse.truncation_rms_doubt, 0.14 * *coarse.truncation_rms);
        }
      }
    }
  }
  EXPECT_GT(given, 30);  // out of 120
}

}  // namespace
}  // namespace rholm
