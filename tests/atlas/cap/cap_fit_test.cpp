// Least squares on a cap, its potential and its surface. Oracles: the sphere, and surfaces made
// from coefficients by the sums of harmonic.h, with normals from differences.
#include "atlas/cap/cap_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "atlas/cap/cap_eval.h"
#include "atlas/cap/cap_pole.h"
#include "atlas/cover/cap_seed.h"
#include "chart/cap/cap_frame.h"
#include "rholm/error.h"
#include "rholm/harmonic.h"
#include "support/random_data.h"
#include "support/targets.h"

namespace rholm {
namespace {

using std::numbers::pi;
using test::random_in;

constexpr double kSupport = 0.3;

CapFrame make_frame() {
  return cap_frame({1, 2, 3}, {0.3, -0.5, 0.9}, kSupport, kHalfAngle, kOpened);
}

// A known function of one basis, with coefficients in the order of atlas.h and of harmonic.h.
struct Known {
  std::vector<double> listed;
  Coefficients f;
};

Known known(CapBasis basis, int degree, double size) {
  Known result{{}, Coefficients(degree)};
  std::uint64_t counter = 0;
  const auto next = [&] { return random_in(-size, size, 12, counter++); };
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      if (basis == CapBasis::kEven && (l + m) % 2 != 0) continue;
      result.listed.push_back(result.f.c(l, m) = next());
      if (m > 0) result.listed.push_back(result.f.s(l, m) = next());
    }
  }
  return result;
}

struct Direction {
  double theta, phi;
};
std::vector<Direction> directions(std::size_t n, double part = 1) {
  std::vector<Direction> all;
  all.reserve(n);
  for (std::uint64_t i = 0; i < n; ++i) {
    all.push_back(
        {part * kHalfAngle * std::sqrt(random_in(0.001, 1, 13, i)), random_in(0, 2 * pi, 14, i)});
  }
  return all;
}

// Returns points of the cap's surface in directions given in its frame.
std::vector<Vec3> surface_at(const CapFrame& frame, const Coefficients& f,
                             const std::vector<Direction>& at) {
  std::vector<Vec3> opened, points;
  for (const auto& [theta, phi] : at) {
    const double wide = 2 * std::atan(frame.dilation * std::tan(theta / 2));
    opened.push_back(
        {std::sin(wide) * std::cos(phi), std::sin(wide) * std::sin(phi), std::cos(wide)});
  }
  const std::vector<double> phi_of = evaluate(f, opened, {.engine = Engine::kDirect});
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto& [theta, phi] = at[i];
    const Vec3 u = std::sin(theta) * std::cos(phi) * frame.x +
                   std::sin(theta) * std::sin(phi) * frame.y + std::cos(theta) * frame.z;
    points.push_back(frame.center + frame.radius * (1 + phi_of[i]) * u);
  }
  return points;
}

// Points of the surface with outward normals from central differences, exact to a few 1e-9.
struct Samples {
  std::vector<Vec3> points, normals;
};
Samples sample(const CapFrame& frame, const Coefficients& f, const std::vector<Direction>& at) {
  constexpr double h = 1e-5;
  std::vector<Direction> moved;
  for (const auto& [theta, phi] : at) {
    moved.insert(
        moved.end(),
        {{theta, phi}, {theta + h, phi}, {theta - h, phi}, {theta, phi + h}, {theta, phi - h}});
  }
  const std::vector<Vec3> x = surface_at(frame, f, moved);
  Samples samples;
  for (std::size_t i = 0; i < x.size(); i += 5) {
    samples.points.push_back(x[i]);
    samples.normals.push_back(normalized(cross(x[i + 1] - x[i + 2], x[i + 3] - x[i + 4])));
  }
  return samples;
}

Cap known_cap(const CapFrame& frame, CapBasis basis, int degree) {
  Cap cap;
  cap.frame = frame;
  cap.basis = basis;
  cap.degree = static_cast<std::uint16_t>(degree);
  return cap;
}

CapPoints points_of(const CapFrame& frame, const Coefficients& f, std::size_t n) {
  const Samples samples = sample(frame, f, directions(n));
  CapPoints points;
  for (std::size_t i = 0; i < n; ++i) {
    points.add(samples.points[i] - frame.seed(), samples.normals[i], random_in(0.1, 1, 15, i));
  }
  points.pad();
  return points;
}

struct Case {
  CapBasis basis;
  int degree;
};
constexpr Case kCases[] = {{CapBasis::kFull, 0},
                           {CapBasis::kFull, 3},
                           {CapBasis::kFull, 5},
                           {CapBasis::kEven, 4},
                           {CapBasis::kEven, 10}};

TEST(CapFit, a_surface_in_the_span_is_recovered) {
  const CapFrame frame = make_frame();
  for (const auto& [basis, degree] : kCases) {
    const Known truth = known(basis, degree, 0.01);
    const CapPoints points = points_of(frame, truth.f, 200);
    // Fits are compared in other directions: the coefficients themselves are less well determined.
    const Samples others = sample(frame, truth.f, directions(50, 0.9));
    const Cap cap = known_cap(frame, basis, degree);
    test::for_each_target([&](const char* target) {
      SCOPED_TRACE(std::string(target) + " " + std::to_string(degree));
      CapFitScratch scratch;
      CapFit fit;
      ASSERT_TRUE(
          fit_cap(frame, points, {.basis = basis, .degree = degree, .penalty = 0}, scratch, fit));
      EXPECT_LT(fit.rms, 1e-9);
      EXPECT_LT(fit.slope_rms, 1e-8);
      EXPECT_EQ(fit.usable, 1);
      for (std::size_t i = 0; i < 50; ++i) {
        const CapValue value = evaluate(cap, fit.coefficients, others.points[i]);
        ASSERT_TRUE(value.valid);
        EXPECT_NEAR(value.distance, 0, 1e-8);
        EXPECT_LT(norm(value.gradient - others.normals[i]), 1e-7);
      }
    });
  }
}

TEST(CapFit, weights_of_normals_choose_between_points_and_normals) {
  const CapFrame frame = make_frame();
  const Known truth = known(CapBasis::kFull, 3, 0.01);
  CapPoints good = points_of(frame, truth.f, 200), turned;
  for (std::size_t i = 0; i < good.size(); ++i) {
    turned.add(good.offset(i), normalized(good.normal(i) + 0.1 * frame.x), good.weight(i));
  }
  turned.pad();
  CapFitScratch scratch;
  CapFit fit;
  ASSERT_TRUE(fit_cap(frame, turned, {.gradient_weight = 1e-4, .penalty = 0}, scratch, fit));
  const double by_points = fit.rms;
  ASSERT_TRUE(fit_cap(frame, turned, {.gradient_weight = 1e4, .penalty = 0}, scratch, fit));
  EXPECT_LT(by_points, 1e-6);
  // A tilt by 0.1 gives 0.1 times the distance from the seed, whose mean is half the support.
  EXPECT_GT(fit.rms, 0.02 * kSupport);
}

TEST(CapFit, penalty_makes_it_smoother) {
  const CapFrame frame = make_frame();
  const CapPoints points = points_of(frame, known(CapBasis::kFull, 3, 0.01).f, 200);
  CapFitScratch scratch;
  const auto roughness = [&](double penalty) {
    CapFit fit;
    EXPECT_TRUE(fit_cap(frame, points, {.penalty = penalty}, scratch, fit));
    double sum = 0;
    for (int l = 0; l <= 3; ++l) {
      for (std::size_t i = static_cast<std::size_t>(l * l);
           i < static_cast<std::size_t>((l + 1) * (l + 1)); ++i) {
        sum += std::pow(l * (l + 1) * fit.coefficients[i], 2);
      }
    }
    return sum;
  };
  EXPECT_LT(roughness(1e-2), roughness(1e-4));
  EXPECT_LT(roughness(1e-4), roughness(0));
}

TEST(CapFit, of_a_sphere_misses_what_degree_three_misses) {
  for (const double support : {0.1, 0.2, 0.4}) {
    const Vec3 seed{0, 0, 1};
    const CapFrame frame = cap_frame(seed, seed, support, kHalfAngle, kOpened);
    CapPoints points;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const double d = support * std::sqrt(random_in(0, 1, 16, i)),
                   phi = random_in(0, 2 * pi, 17, i);
      const Vec3 p{d * std::cos(phi), d * std::sin(phi), std::sqrt(1 - d * d)};
      points.add(p - seed, p, 1);
    }
    points.pad();
    CapFitScratch scratch;
    CapFit fit;
    ASSERT_TRUE(fit_cap(frame, points, {}, scratch, fit));
    // The height over the tangent plane is d^2/2 + d^4/8 + ...; the penalty adds its share.
    const double r4 = std::pow(support, 4) / 8;
    EXPECT_LT(fit.rms, r4 + 1e-4 * support);
    EXPECT_NEAR(fit.deviation, 1 - std::sqrt(1 - support * support), 0.01 * support * support);
    // The distance is exact to first order: at height h the error is at most of order h^2, because
    // the curvature is 1.
    const Cap cap = known_cap(frame, CapBasis::kFull, 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 p = seed + points.offset(i);
      for (const double h : {-0.2, -0.1, -0.02, 0.0, 0.02, 0.1, 0.2}) {
        const double height = h * support;
        const CapValue value = evaluate(cap, fit.coefficients, (1 + height) * p);
        ASSERT_TRUE(value.valid);
        EXPECT_NEAR(value.distance, height, height * height + 2 * (r4 + 1e-4 * support));
        EXPECT_LT(norm(value.gradient - p), std::abs(height) + 4 * std::pow(support, 3) / 2 + 1e-3);
      }
    }
  }
}

TEST(CapFit, too_few_points_or_none_that_face_the_sphere_are_refused) {
  const CapFrame frame = make_frame();
  const CapPoints good = points_of(frame, Coefficients(0), 40);
  CapFitScratch scratch;
  CapFit fit;
  CapPoints none;
  EXPECT_FALSE(fit_cap(frame, none, {}, scratch, fit));
  CapPoints few, away;
  for (std::size_t i = 0; i < 5; ++i) few.add(good.offset(i), good.normal(i), 1);
  few.pad();
  EXPECT_FALSE(fit_cap(frame, few, {}, scratch, fit));  // 15 rows for 16 unknowns
  for (std::size_t i = 0; i < 40; ++i) away.add(good.offset(i), -good.normal(i), 1);
  away.pad();
  EXPECT_FALSE(fit_cap(frame, away, {}, scratch, fit));
  EXPECT_EQ(fit.usable, 0);
}

TEST(CapPoints, of_a_sunflower_stand_for_equal_areas) {
  const CapFrame frame = make_frame();
  CapPoints points;
  add_sunflower(frame, 20000, points);
  ASSERT_EQ(points.size(), 20000u);
  // Point k is the k-th nearest to the seed, a golden angle after point k - 1. Every half plane and
  // every disc about the seed has a number of points proportional to its area, except for a few.
  std::size_t left = 0, above = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double x = dot(points.offset(k), frame.x), y = dot(points.offset(k), frame.y);
    EXPECT_NEAR(dot(points.offset(k), frame.z), 0, 1e-15);
    const double part = (static_cast<double>(k) + 0.5) / 20000;
    EXPECT_NEAR(x * x + y * y, part * kSupport * kSupport, 1e-12);
    const double angle = static_cast<double>(k) * pi * (3 - std::sqrt(5.0));
    EXPECT_NEAR(x * std::sin(angle) - y * std::cos(angle), 0, 1e-11);
    left += x<0, above += y> 0;
  }
  EXPECT_NEAR(static_cast<double>(left), 10000, 10);
  EXPECT_NEAR(static_cast<double>(above), 10000, 10);
}

// ---- Potential and surface ----

TEST(CapEval, its_surface_is_that_of_the_coefficients) {
  const CapFrame frame = make_frame();
  for (const auto& [basis, degree] : kCases) {
    const Known truth = known(basis, degree, 0.02);
    const Cap cap = known_cap(frame, basis, degree);
    const Samples expected = sample(frame, truth.f, directions(30));
    CapPoints points;
    for (const Vec3& p : expected.points) {
      points.add(p + 0.1 * (p - frame.center) - frame.seed(), frame.z, 1);  // farther on the ray
    }
    points.pad();
    const std::size_t stride = points.padded();
    std::vector<double> at(3 * stride), across(3 * stride), distance(stride);
    test::for_each_target([&](const char* target) {
      SCOPED_TRACE(std::string(target) + " " + std::to_string(degree));
      cap_surface(cap, truth.listed, points, at, across);
      cap_distances(cap, truth.listed, points, distance);
      for (std::size_t i = 0; i < 30; ++i) {
        const Vec3 p = frame.seed() + Vec3{at[i], at[stride + i], at[2 * stride + i]};
        const Vec3 n{across[i], across[stride + i], across[2 * stride + i]};
        EXPECT_LT(norm(p - expected.points[i]), 1e-12);
        EXPECT_LT(norm(n - expected.normals[i]), 5e-8);
        // (|x - c| - r) cos(gamma)
        const Vec3 ray = expected.points[i] - frame.center;
        EXPECT_NEAR(distance[i], 0.1 * dot(ray, expected.normals[i]), 5e-8);
      }
    });
  }
}

TEST(CapEval, behind_the_centre_and_below_it_there_is_nothing) {
  const CapFrame frame = make_frame();
  const Cap cap = known_cap(frame, CapBasis::kFull, 0);
  const std::vector<double> unit = {0}, negative = {-2 * std::sqrt(4 * pi)};
  EXPECT_TRUE(evaluate(cap, unit, frame.seed()).valid);
  EXPECT_FALSE(evaluate(cap, unit, frame.center).valid);
  EXPECT_FALSE(evaluate(cap, unit, frame.center - frame.z).valid);
  EXPECT_FALSE(evaluate(cap, negative, frame.seed()).valid);  // r = -R_0
}

TEST(Cap, names_of_what_it_may_be_read_back) {
  for (const CapBlend blend : {CapBlend::kSmooth, CapBlend::kSpline}) {
    EXPECT_EQ(parse_name<CapBlend>(to_string(blend)), blend);
  }
  for (const CapExtension extension : {CapExtension::kZero, CapExtension::kSphere}) {
    EXPECT_EQ(parse_name<CapExtension>(to_string(extension)), extension);
  }
  EXPECT_THROW(parse_name<CapBlend>("rough"), Error);
  EXPECT_THROW(parse_name<CapExtension>(""), Error);
}

TEST(CapPole, is_the_surface_over_the_seed) {
  const CapFrame frame = make_frame();
  for (const auto& [basis, degree] : kCases) {
    const Known truth = known(basis, degree, 0.02);
    Atlas atlas;
    atlas.caps = {known_cap(frame, basis, degree)};
    atlas.coefficients = truth.listed;
    const CapFoot foot = cap_foot(atlas, atlas.caps[0]);
    const CapValue value = evaluate(atlas.caps[0], truth.listed, foot.point);
    EXPECT_NEAR(value.distance, 0, 1e-14);
    EXPECT_LT(norm(cross(foot.point - frame.center, frame.z)), 1e-14);
    EXPECT_LT(norm(value.gradient - foot.normal), 1e-13);
  }
}

TEST(CapSystem, leading_blocks_are_the_fits_of_lower_degrees) {
  const CapFrame frame = make_frame();
  const CapPoints points = points_of(frame, known(CapBasis::kEven, 8, 0.01).f, 300);
  CapFitOptions options{.basis = CapBasis::kEven, .degree = 8};
  CapFitScratch scratch, other;
  const CapSystem system = make_system(frame, points, options, scratch);
  ASSERT_TRUE(system.solvable);
  ASSERT_EQ(scratch.factor.factor(scratch.matrix.data(), system.n, 1e-13), system.n);
  for (int degree = 0; degree <= 8; ++degree) {
    const std::size_t n = n_coefficients(CapBasis::kEven, degree);
    std::vector<double> coefficients;
    scratch.factor.solve(n, coefficients);
    CapFit fit;
    ASSERT_TRUE(fit_cap(frame, points, {.basis = CapBasis::kEven, .degree = degree}, other, fit));
    ASSERT_EQ(fit.coefficients.size(), n);
    // The condition of the matrix is below 1e6.
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(coefficients[i], fit.coefficients[i], 1e-9);
  }
}

}  // namespace
}  // namespace rholm
