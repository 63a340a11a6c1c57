#include "transform/norms/parseval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rholm/analyze.h"
#include "rholm/primitives.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

constexpr double kSphere = 4 * std::numbers::pi;

// 3 in c_00, 4 over the others, and 0.5 beyond them.
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

// The worst errors lie along the coefficients themselves: then the doubt is what the rest is off,
// up to twice the square of the error, which the size that is found has instead of the true one.
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

// Of any precision: nothing, or within the doubt of what exact coefficients have.
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
  EXPECT_GT(given, 30);  // of 120
}

}  // namespace
}  // namespace rholm
