#include "rholm/grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "harmonic/rings/ring_rules.h"
#include "rholm/error.h"
#include "rholm/harmonic.h"
#include "support/random_data.h"

namespace rholm {
namespace {

using test::norm_of;
using test::random_coefficients;
using test::random_values;
using test::relative_difference;

constexpr double kPi = std::numbers::pi;
constexpr GridKind kKinds[] = {GridKind::kGaussLegendre, GridKind::kEquiangular,
                               GridKind::kEquiangularWithPoles};

std::vector<Vec3> directions_of(const Grid& grid) {
  std::vector<Vec3> directions;
  for (const double theta : grid_colatitudes(grid)) {
    for (int k = 0; k < grid.n_phi; ++k) {
      const double phi = 2 * kPi * k / grid.n_phi, s = std::sin(theta);
      directions.push_back({s * std::cos(phi), s * std::sin(phi), std::cos(theta)});
    }
  }
  return directions;
}

template <typename Call>
void expect_refused(Call call) {
  try {
    call();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
  }
}

TEST(grid, rings_stand_where_the_header_says) {
  const auto centered = grid_colatitudes({GridKind::kEquiangular, 4, 1});
  EXPECT_DOUBLE_EQ(centered[0], kPi / 8);
  EXPECT_DOUBLE_EQ(centered[3], 7 * kPi / 8);
  const auto poles = grid_colatitudes({GridKind::kEquiangularWithPoles, 5, 1});
  EXPECT_EQ(poles.front(), 0);
  EXPECT_DOUBLE_EQ(poles[2], kPi / 2);
  EXPECT_DOUBLE_EQ(poles.back(), kPi);
  for (const int n : {1, 2, 3, 10, 201}) {
    const auto gauss = grid_colatitudes({GridKind::kGaussLegendre, n, 1});
    const GaussRule rule = gauss_legendre(n);
    ASSERT_EQ(gauss.size(), static_cast<std::size_t>(n));
    // cos loses the digits that theta has in addition near the poles.
    for (int i = 0; i < n; ++i) EXPECT_NEAR(std::cos(gauss[i]), rule.nodes[i], 5e-16);
  }
}

// int_0^pi cos(k theta) sin(theta) dtheta = 2 / (1 - k^2) for even k, 0 for odd ones.
TEST(ring_rules, integrate_cosines_as_far_as_promised) {
  for (const std::size_t n : {1u, 2u, 3u, 16u, 17u, 64u, 201u, 1000u}) {
    for (const bool gauss : {true, false}) {
      const RingRule rule = gauss ? gauss_ring_rule(n) : fejer_ring_rule(n);
      for (std::size_t k = 0; k <= (gauss ? 2 * n - 1 : n - 1); k += 1 + n / 16) {
        const double kk = static_cast<double>(k);
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) {
          sum += rule.weights[i] * std::cos(kk * rule.colatitudes[i]);
        }
        // The bound is the rounding of k theta, of either sign.
        EXPECT_NEAR(sum, k % 2 == 0 ? 2 / (1 - kk * kk) : 0, 8e-15 + 2e-17 * kk) << n << " " << k;
      }
    }
  }
}

TEST(grid, synthesis_is_evaluation_at_the_directions) {
  for (const GridKind kind : kKinds) {
    for (const Grid& grid : {Grid{kind, 2, 41}, Grid{kind, 7, 50}, Grid{kind, 24, 43}}) {
      const Coefficients f = random_coefficients(20, 5);
      const auto values = synthesize_grid(f, grid);
      const auto expected = evaluate(f, directions_of(grid), {.engine = Engine::kDirect});
      ASSERT_EQ(values.size(), expected.size());
      for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(values[i], expected[i], 1e-13 * norm_of(f.values()));
      }
    }
  }
}

// Uses the smallest grid and larger grids, with even and odd numbers of rings and columns.
TEST(grid, analysis_undoes_synthesis) {
  for (const GridKind kind : kKinds) {
    for (const int degree : {0, 1, 2, 3, 10, 31, 32, 100, 255}) {
      const Coefficients f = random_coefficients(degree, 9);
      const Grid smallest = smallest_grid(kind, degree);
      EXPECT_EQ(exact_degree(smallest), degree);
      const Grid exact = {kind, smallest.n_theta, 2 * degree + 1};
      const Grid finer = {kind, smallest.n_theta + 5, smallest.n_phi + 3};
      const Grid twice = {kind, 2 * smallest.n_theta + 1, smallest.n_phi};
      for (const Grid& grid : {smallest, exact, finer, twice}) {
        const Coefficients back = analyze_grid(synthesize_grid(f, grid), grid, degree);
        // The error is measured at most 2e-14.
        EXPECT_LT(relative_difference(back, f), 1e-13) << degree << " " << grid.n_theta;
      }
    }
  }
}

TEST(grid, analysis_to_a_lower_degree_is_exact_too) {
  for (const GridKind kind : kKinds) {
    const Coefficients f = random_coefficients(40, 3);
    const Grid grid = smallest_grid(kind, 40);
    const auto values = synthesize_grid(f, grid);
    for (const int degree : {0, 1, 7, 39}) {
      EXPECT_LT(relative_difference(analyze_grid(values, grid, degree), f.resized(degree)), 1e-13);
    }
  }
}

// f = 1 has sqrt(4 pi); z has sqrt(4 pi / 3) at (1, 0), as x and y at (1, 1).
TEST(grid, analysis_of_coordinates_has_their_textbook_coefficients) {
  for (const GridKind kind : kKinds) {
    const Grid grid = {kind, 6, 7};
    std::vector<double> values;
    for (const Vec3& u : directions_of(grid)) values.push_back(1 + 2 * u.x + 3 * u.y + 4 * u.z);
    const Coefficients f = analyze_grid(values, grid, 3);
    Coefficients expected(3);
    const double unit = std::sqrt(4 * kPi / 3);
    expected.c(0, 0) = std::sqrt(4 * kPi);
    expected.c(1, 1) = 2 * unit;
    expected.s(1, 1) = 3 * unit;
    expected.c(1, 0) = 4 * unit;
    EXPECT_LT(relative_difference(f, expected), 1e-15 * 10);
  }
}

TEST(grid, high_degrees_keep_their_digits) {
  const Coefficients f = random_coefficients(600, 2);
  for (const GridKind kind : kKinds) {
    const Grid grid = smallest_grid(kind, 600);
    const Coefficients back = analyze_grid(synthesize_grid(f, grid), grid, 600);
    EXPECT_LT(relative_difference(back, f), 1e-12);
  }
}

TEST(grid, same_bits_for_any_number_of_threads) {
  const Coefficients f = random_coefficients(60, 8);
  for (const GridKind kind : kKinds) {
    const Grid grid = smallest_grid(kind, 60);
    const auto one = synthesize_grid(f, grid, {.threads = 1, .progress = {}});
    const auto four = synthesize_grid(f, grid, {.threads = 4, .progress = {}});
    EXPECT_EQ(one, four);
    const Coefficients a = analyze_grid(one, grid, 60, {.threads = 1, .progress = {}});
    const Coefficients b = analyze_grid(one, grid, 60, {.threads = 4, .progress = {}});
    for (std::size_t i = 0; i < a.values().size(); ++i) EXPECT_EQ(a.values()[i], b.values()[i]);
  }
}

TEST(grid, values_beyond_the_exact_degree_are_finite) {
  for (const GridKind kind : kKinds) {
    const Grid grid = {kind, 9, 16};
    const Coefficients f = analyze_grid(random_values(9 * 16, 4), grid, 7);
    for (const double value : f.values()) EXPECT_TRUE(std::isfinite(value));
  }
}

TEST(grid, what_cannot_be_exact_is_refused) {
  const Coefficients f(10);
  expect_refused([&] { synthesize_grid(f, {GridKind::kGaussLegendre, 11, 20}); });
  expect_refused([&] { synthesize_grid(f, {GridKind::kGaussLegendre, 0, 21}); });
  expect_refused([&] { synthesize_grid(f, {GridKind::kEquiangularWithPoles, 1, 21}); });
  expect_refused([&] { synthesize_grid(f, {GridKind::kGaussLegendre, 11, 0}); });
  expect_refused([&] { synthesize_grid(f, {GridKind::kGaussLegendre, 11, 1 << 20}); });
  expect_refused([&] { grid_colatitudes({GridKind::kEquiangular, -3, 21}); });
  expect_refused([&] { grid_colatitudes({GridKind::kEquiangular, 1 << 20, 21}); });
  expect_refused([&] { smallest_grid(GridKind::kEquiangular, -1); });
  const std::vector<double> values(11 * 21, 1.0);
  const Grid grid = {GridKind::kGaussLegendre, 11, 21};
  expect_refused([&] { analyze_grid(values, grid, 11); });
  expect_refused([&] { analyze_grid(values, grid, -1); });
  expect_refused([&] { analyze_grid(values, {GridKind::kGaussLegendre, 11, 22}, 10); });
  expect_refused([&] { analyze_grid(values, {GridKind::kEquiangularWithPoles, 11, 21}, 10); });
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::vector<double> spoiled = values;
    spoiled[100] = bad;
    expect_refused([&] { analyze_grid(spoiled, grid, 10); });
  }
}

TEST(grid, can_be_cancelled) {
  const Context context{.threads = 1, .progress = [](std::string_view, double) { return false; }};
  const Grid grid = smallest_grid(GridKind::kGaussLegendre, 20);
  EXPECT_THROW(synthesize_grid(Coefficients(20), grid, context), Error);
  EXPECT_THROW(analyze_grid(synthesize_grid(Coefficients(20), grid), grid, 20, context), Error);
}

}  // namespace
}  // namespace rholm
