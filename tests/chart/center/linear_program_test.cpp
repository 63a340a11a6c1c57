#include "chart/center/linear_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random_data.h"

namespace rholm {
namespace {

using test::random_direction;
using test::random_in;

// Solves a 4 x 4 system by Cramer's rule in long double; false if it is nearly singular.
using Quad = std::array<long double, 4>;
long double determinant3(const Quad& a, const Quad& b, const Quad& c, int i, int j, int k) {
  return a[i] * (b[j] * c[k] - b[k] * c[j]) - a[j] * (b[i] * c[k] - b[k] * c[i]) +
         a[k] * (b[i] * c[j] - b[j] * c[i]);
}
long double determinant(const std::array<Quad, 4>& columns) {
  const auto& [a, b, c, d] = columns;
  return a[0] * determinant3(b, c, d, 1, 2, 3) - a[1] * determinant3(b, c, d, 0, 2, 3) +
         a[2] * determinant3(b, c, d, 0, 1, 3) - a[3] * determinant3(b, c, d, 0, 1, 2);
}

// Returns the largest t over all vertices of the feasible set, by trying all sets of four rows.
double largest_by_enumeration(const std::vector<Row>& rows) {
  const std::size_t n = rows.size();
  double best = -1e300;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        for (std::size_t m = 0; m < k; ++m) {
          std::array<Quad, 4> columns;
          Quad bound;
          const std::size_t chosen[4] = {i, j, k, m};
          for (int r = 0; r < 4; ++r) {
            const Row& row = rows[chosen[r]];
            columns[0][r] = row.a.x;
            columns[1][r] = row.a.y;
            columns[2][r] = row.a.z;
            columns[3][r] = row.lift;
            bound[r] = row.bound;
          }
          const long double whole = determinant(columns);
          if (std::abs(whole) < 1e-12L) continue;
          Quad x;
          for (int c = 0; c < 4; ++c) {
            std::array<Quad, 4> replaced = columns;
            replaced[c] = bound;
            x[c] = determinant(replaced) / whole;
          }
          const bool feasible = std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
            return row.a.x * x[0] + row.a.y * x[1] + row.a.z * x[2] + row.lift * x[3] <=
                   row.bound + 1e-10L;
          });
          if (feasible) best = std::max(best, static_cast<double>(x[3]));
        }
      }
    }
  }
  return best;
}

double worst_violation(const LinearProgram& program) {
  double worst = 0;
  for (const Row& row : program.rows()) {
    worst = std::max(worst, dot(row.a, program.center()) + row.lift * program.top() - row.bound);
  }
  return worst;
}

// The weights of the basis add up to the objective. With feasibility, this proves optimality.
void expect_certified(const LinearProgram& program) {
  EXPECT_LE(worst_violation(program), 1e-13);
  Vec3 sum;
  double lift = 0, bound = 0;
  for (int i = 0; i < 4; ++i) {
    const Row& row = program.rows()[program.basis()[i]];
    EXPECT_GE(program.weights()[i], -1e-12);
    sum += program.weights()[i] * row.a;
    lift += program.weights()[i] * row.lift;
    bound += program.weights()[i] * row.bound;
  }
  EXPECT_NEAR(norm(sum), 0, 1e-12);
  EXPECT_NEAR(lift, 1, 1e-12);
  EXPECT_NEAR(bound, program.top(), 1e-12);
}

TEST(linear_program, agrees_with_the_enumeration_of_all_vertices) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    LinearProgram program(1.5, 3);
    const int n = 4 + static_cast<int>(seed % 9);
    for (int i = 0; i < n; ++i) {
      program.add(
          {.a = random_direction(seed, i), .lift = 1, .bound = random_in(-0.2, 1, seed + 1000, i)});
    }
    ASSERT_TRUE(program.solve()) << seed;
    EXPECT_NEAR(program.top(), largest_by_enumeration(program.rows()), 1e-11) << seed;
    expect_certified(program);
  }
}

// Rows pass through one point and have normals on a lattice: every vertex is highly degenerate.
TEST(linear_program, does_not_cycle_on_degenerate_rows) {
  LinearProgram program(1, 3);
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) {
      for (int k = -2; k <= 2; ++k) {
        const Vec3 n{1.0 * i, 1.0 * j, 1.0 * k};
        if (norm(n) == 0) continue;
        for (int copy = 0; copy < 3; ++copy) {
          program.add(
              {.a = normalized(n), .lift = 1, .bound = 0.5 + dot(normalized(n), {0.1, 0.2, 0.3})});
        }
      }
    }
  }
  ASSERT_TRUE(program.solve());
  EXPECT_NEAR(program.top(), 0.5, 1e-14);
  EXPECT_NEAR(norm(program.center() - Vec3{0.1, 0.2, 0.3}), 0, 1e-14);
  expect_certified(program);
}

TEST(linear_program, takes_rows_in_rounds_as_well_as_at_once) {
  LinearProgram once(1, 3), rounds(1, 3);
  for (int i = 0; i < 2000; ++i) {
    const Row row{.a = random_direction(7, i), .lift = 1, .bound = random_in(0.5, 1, 8, i)};
    once.add(row);
    rounds.add(row);
    if (i % 100 == 0) {
      ASSERT_TRUE(rounds.solve());
    }
  }
  ASSERT_TRUE(once.solve());
  ASSERT_TRUE(rounds.solve());
  EXPECT_NEAR(once.top(), rounds.top(), 1e-13);
  expect_certified(once);
}

// Two groups of planes face each other at distance 1; rounding turns the planes of each group.
TEST(linear_program, ends_where_rounding_turns_planes_against_each_other) {
  constexpr double kTurn = 1e-7;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    LinearProgram program(1, 3);
    const Vec3 up = random_direction(seed, 0);
    for (int i = 1; i < 60; ++i) {
      const Vec3 normal = (i % 2 == 0 ? 1 : -1) * up + kTurn * random_direction(seed, i);
      program.add({.a = normalized(normal), .lift = 1, .bound = 0.5, .rounding = 4 * kTurn});
    }
    ASSERT_TRUE(program.solve(true)) << seed;
    EXPECT_NEAR(program.top(), 0.5, 4 * kTurn) << seed;
    EXPECT_NEAR(dot(program.center(), up), 0, 4 * kTurn) << seed;
    EXPECT_LE(worst_violation(program), 4 * kTurn + 1e-13) << seed;
  }
}

TEST(linear_program, without_rows_is_at_its_own_limits) {
  LinearProgram program(1.5, 3);
  ASSERT_TRUE(program.solve());
  EXPECT_EQ(program.top(), 3);
  EXPECT_EQ(program.center(), (Vec3{1.5, 1.5, 1.5}));
}

}  // namespace
}  // namespace rholm
