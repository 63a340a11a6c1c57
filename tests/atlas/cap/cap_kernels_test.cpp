// The kernels of caps with any number of points, and with arbitrary values in scratch memory. Every
// instruction set is tested, because the number of points in the last vector differs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "atlas/cap/cap_eval.h"
#include "atlas/cap/cap_fit.h"
#include "atlas/cover/cap_seed.h"
#include "base/poison.h"
#include "chart/cap/cap_frame.h"
#include "support/random_data.h"
#include "support/targets.h"

namespace rholm {
namespace {

using test::random_in;

constexpr std::size_t kMostPoints = 33;

CapFrame make_frame() { return cap_frame({1, 2, 3}, {0.3, -0.5, 0.9}, 0.3, kHalfAngle, kOpened); }

// Adds point i near the tangent plane, with a normal near the axis.
void add_point(const CapFrame& frame, std::uint64_t i, double share, CapPoints& points) {
  const auto at = [&](std::uint64_t stream, double size) {
    return random_in(-size, size, stream, i);
  };
  points.add(at(1, 0.2) * frame.x + at(2, 0.2) * frame.y + at(3, 0.02) * frame.z,
             normalized(frame.z + at(4, 0.2) * frame.x + at(5, 0.2) * frame.y),
             share * random_in(0.5, 1, 6, i));
}

CapPoints some_points(const CapFrame& frame, std::size_t n) {
  CapPoints points;
  for (std::uint64_t i = 0; i < n; ++i) add_point(frame, i, 1, points);
  points.pad();
  return points;
}

// Returns the used part of the normal equations.
std::vector<double> matrix_of(const CapFrame& frame, const CapPoints& points, int degree,
                              CapFitScratch& scratch) {
  const CapFitOptions options{.degree = degree, .penalty = 0};
  const CapSystem system = make_system(frame, points, options, scratch);
  EXPECT_TRUE(system.solvable);
  EXPECT_EQ(system.usable, points.size());
  std::vector<double> upper;
  for (std::size_t i = 0; i <= system.n; ++i) {
    for (std::size_t j = i; j <= system.n; ++j) {
      upper.push_back(scratch.matrix[i * (system.n + 1) + j]);
    }
  }
  return upper;
}

// Eight copies of a point fill the vectors of every instruction set, so that no vector is partial.
TEST(CapKernels, normal_equations_are_the_sum_of_those_of_single_points) {
  const CapFrame frame = make_frame();
  test::for_each_target([&](const char* target) {
    CapFitScratch scratch, single;
    for (const int degree : {0, 1, 2, 3}) {
      const std::size_t unknowns = n_coefficients(CapBasis::kFull, degree);
      std::vector<double> expected((unknowns + 1) * (unknowns + 2) / 2, 0.0);
      for (std::size_t n = 1; n <= kMostPoints; ++n) {
        CapPoints eight;
        for (int copy = 0; copy < 8; ++copy) add_point(frame, n - 1, 1.0 / 8, eight);
        eight.pad();
        const std::vector<double> one = matrix_of(frame, eight, degree, single);
        for (std::size_t k = 0; k < one.size(); ++k) expected[k] += one[k];
        if (3 * n < unknowns) continue;
        const std::vector<double> all = matrix_of(frame, some_points(frame, n), degree, scratch);
        for (std::size_t k = 0; k < all.size(); ++k) {
          ASSERT_NEAR(all[k], expected[k], 1e-13 * static_cast<double>(n)) << target << " " << n;
        }
      }
    }
  });
}

TEST(CapKernels, a_fit_has_the_same_bits_on_fresh_and_on_used_scratch) {
  const CapFrame frame = make_frame();
  const CapPoints before = some_points(frame, 61);
  test::for_each_target([&](const char* target) {
    CapFitScratch used;
    for (std::size_t n = 6; n <= kMostPoints; ++n) {
      const CapPoints points = some_points(frame, n);
      CapFit fit, expected;
      ASSERT_TRUE(fit_cap(frame, before, {.degree = 4}, used, fit));
      ASSERT_TRUE(fit_cap(frame, points, {}, used, fit));
      CapFitScratch fresh;
      ASSERT_TRUE(fit_cap(frame, points, {}, fresh, expected));
      EXPECT_EQ(fit.coefficients, expected.coefficients) << target << " " << n;
      EXPECT_EQ(fit.rms, expected.rms);
      EXPECT_EQ(fit.slope_rms, expected.slope_rms);
    }
  });
}

// The point at the centre of the cap has no direction, and the point opposite the axis no place in
// the plane. Both are exact because the axis is a coordinate axis. Their weight is zero, so that
// the penalty stays the same.
TEST(CapKernels, points_that_cannot_be_fitted_do_not_matter) {
  const CapFrame frame = cap_frame({}, {0, 0, 1}, 0.3, kHalfAngle, kOpened);
  const CapPoints points = some_points(frame, 30);
  CapPoints more;
  for (std::size_t i = 0; i < 30; ++i) {
    more.add(points.offset(i), points.normal(i), points.weight(i));
    if (i == 7) more.add({0, 0, -frame.radius}, frame.z, 0);
    if (i == 20) more.add({0, 0, -2 * frame.radius}, -frame.z, 0);
  }
  more.pad();
  test::for_each_target([&](const char* target) {
    SCOPED_TRACE(target);
    CapFitScratch scratch;
    CapFit fit, expected;
    ASSERT_TRUE(fit_cap(frame, points, {}, scratch, expected));
    ASSERT_TRUE(fit_cap(frame, more, {}, scratch, fit));
    EXPECT_EQ(fit.usable, 30.0 / 32);
    for (std::size_t i = 0; i < fit.coefficients.size(); ++i) {
      EXPECT_NEAR(fit.coefficients[i], expected.coefficients[i], 1e-9);
    }
  });
}

TEST(CapKernels, values_at_a_point_do_not_depend_on_those_beside_it) {
  const CapFrame frame = make_frame();
  Cap cap;
  cap.frame = frame;
  cap.degree = 3;
  std::vector<double> coefficients(n_coefficients(CapBasis::kFull, 3));
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    coefficients[i] = random_in(-0.01, 0.01, 7, i);
  // Seven rows of `stride` values: three of positions, three of normals, one of distances.
  const auto values = [&](const CapPoints& points) {
    const std::size_t stride = points.padded();
    std::vector<double> all(7 * stride);
    poison_scratch(std::span(all));
    const std::span<double> rows(all);
    cap_surface(cap, coefficients, points, rows.first(3 * stride),
                rows.subspan(3 * stride, 3 * stride));
    cap_distances(cap, coefficients, points, rows.last(stride));
    return all;
  };
  test::for_each_target([&](const char* target) {
    for (std::size_t n = 1; n <= kMostPoints; ++n) {
      const CapPoints points = some_points(frame, n);
      CapPoints alone;
      alone.add(points.offset(n - 1), points.normal(n - 1), 1);
      alone.pad();
      const std::vector<double> all = values(points), one = values(alone);
      for (std::size_t row = 0; row < 7; ++row) {
        EXPECT_EQ(all[row * points.padded() + n - 1], one[row * alone.padded()]) << target << n;
      }
      const std::size_t stride = alone.padded();
      const Vec3 foot = frame.seed() + Vec3{one[0], one[stride], one[2 * stride]};
      EXPECT_NEAR(evaluate(cap, coefficients, foot).distance, 0, 1e-13) << target << " " << n;
    }
  });
}

}  // namespace
}  // namespace rholm
