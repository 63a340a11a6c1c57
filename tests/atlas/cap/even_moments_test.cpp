// Fits of even harmonics, with a matrix made from moments. Oracle: the rows of all harmonics.
#include "atlas/cap/even_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "atlas/cap/cap_fit.h"
#include "atlas/cover/cap_seed.h"
#include "chart/cap/cap_frame.h"
#include "harmonic/legendre/low_harmonics.h"
#include "support/random_data.h"
#include "support/targets.h"

namespace rholm {
namespace {

using test::random_in;

CapFrame make_frame() { return cap_frame({1, 2, 3}, {0.3, -0.5, 0.9}, 0.3, kHalfAngle, kOpened); }

// Returns points about the cap; some of them face away, and one lies at the seed.
CapPoints make_points(const CapFrame& frame, std::size_t n) {
  CapPoints points;
  for (std::uint64_t i = 0; i < n; ++i) {
    const auto at = [&](std::uint64_t stream, double size) {
      return i == 0 ? 0 : random_in(-size, size, stream, i);
    };
    const Vec3 normal = normalized(frame.z + at(4, 0.9) * frame.x + at(5, 0.9) * frame.y);
    points.add(at(1, 0.3) * frame.x + at(2, 0.3) * frame.y + at(3, 0.1) * frame.z,
               i % 7 == 3 ? -normal : normal, random_in(0, 2, 6, i));
  }
  points.pad();
  return points;
}

// Returns the indices of the even harmonics among all harmonics.
std::vector<std::size_t> even_places(int degree) {
  std::vector<std::size_t> places;
  for (int l = 0; l <= degree; ++l) {
    for (int m = l % 2; m <= l; m += 2) {
      places.push_back(low_index(l, m));
      if (m > 0) places.push_back(low_index(l, m) + 1);
    }
  }
  return places;
}

TEST(EvenMoments, matrix_is_that_of_the_rows_of_the_harmonics) {
  const CapFrame frame = make_frame();
  for (const int degree : {0, 1, 2, 3, 7, 14, kMaxLowDegree}) {
    const std::vector<std::size_t> places = even_places(degree);
    for (const std::size_t n : {400, 401, 409}) {
      const CapPoints points = make_points(frame, n);
      test::for_each_target([&](const char* target) {
        SCOPED_TRACE(std::string(target) + ", " + std::to_string(degree));
        CapFitScratch scratch, all;
        const CapFitOptions even{CapBasis::kEven, degree, 0.3, 2e-9};
        const CapFitOptions full{CapBasis::kFull, degree, 0.3, 2e-9};
        const CapSystem system = make_system(frame, points, even, scratch);
        const CapSystem rows = make_system(frame, points, full, all);
        ASSERT_TRUE(system.solvable && rows.solvable);
        ASSERT_EQ(system.n, places.size());
        EXPECT_EQ(system.usable, rows.usable);
        EXPECT_LT(system.usable, n);
        // Rows are in the order of the matrix, whose first row is the right-hand side.
        std::vector<std::size_t> from = {0};
        for (const std::size_t place : places) from.push_back(1 + place);
        const auto of_rows = [&](std::size_t i, std::size_t j) {
          return all.matrix[from[i] * (rows.n + 1) + from[j]];
        };
        for (std::size_t i = 0; i < from.size(); ++i) {
          for (std::size_t j = i; j < from.size(); ++j) {
            const double size = std::sqrt(of_rows(i, i) * of_rows(j, j));
            EXPECT_NEAR(scratch.matrix[i * from.size() + j], of_rows(i, j), 1e-12 * size);
          }
        }
      });
    }
  }
}

TEST(EvenMoments, residuals_are_those_of_the_rows) {
  const CapFrame frame = make_frame();
  const CapPoints points = make_points(frame, 403);
  CapFitScratch scratch, all;
  const CapSystem system = make_system(frame, points, {CapBasis::kEven, 9, 0.3, 0}, scratch);
  const CapSystem rows = make_system(frame, points, {CapBasis::kFull, 9, 0.3, 0}, all);
  for (const int degree : {0, 4, 9}) {
    const std::vector<std::size_t> places = even_places(degree);
    std::vector<double> even, full(static_cast<std::size_t>((degree + 1) * (degree + 1)));
    for (std::size_t i = 0; i < places.size(); ++i) {
      even.push_back(random_in(-0.1, 0.1, 7, i));
      full[places[i]] = even[i];
    }
    test::for_each_target([&](const char* target) {
      SCOPED_TRACE(target);
      for (const bool slopes : {false, true}) {
        const double* const found = residuals(system, even, slopes, scratch);
        const double* const expected = residuals(rows, full, slopes, all);
        for (std::size_t i = 0; i < (slopes ? 3 : 1) * system.third; ++i) {
          EXPECT_NEAR(found[i], expected[i], 1e-13);
        }
      }
    });
  }
}

}  // namespace
}  // namespace rholm
