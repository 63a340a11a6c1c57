// Compares with plain sums and substitutions in long double. Every instruction set is tested,
// because the number of values in the last vector differs.
#include "atlas/cap/normal_equations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "support/random_data.h"
#include "support/targets.h"

namespace rholm {
namespace {

using test::random_in;
using Real = long double;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
constexpr double kLeast = 1e-13;

std::vector<std::size_t> sizes_to_test() {
  std::vector<std::size_t> sizes(33);
  std::iota(sizes.begin(), sizes.end(), std::size_t{1});
  sizes.insert(sizes.end(), {45, 120});
  return sizes;
}

// Random rows of n unknowns with at least four times as many values each: the condition is a few
// tens. Memory after the length of each row is NaN, and so is memory after the last row.
struct Problem {
  std::size_t n, length, stride;
  std::vector<double> rows, weights;
  Problem(std::size_t unknowns, std::size_t more)
      : n(unknowns), length(padded(4 * unknowns + more)), stride(length + kCapLanes) {
    rows.assign((n + 4) / 4 * 4 * stride, kNan);
    for (std::size_t i = 0; i <= n; ++i) {
      for (std::size_t k = 0; k < length; ++k) {
        rows[i * stride + k] = random_in(-1, 1, i, k);
      }
    }
    for (std::size_t k = 0; k < length; ++k) weights.push_back(random_in(0.5, 1.5, 1000, k));
  }
  NormalRows all(bool weighted) const {
    return {rows.data(), n + 1, length, stride, weighted ? weights.data() : nullptr};
  }
  std::vector<double> matrix() const {
    std::vector<double> result((n + 1) * (n + 1), kNan);
    make_normal_matrix(all(true), result.data());
    return result;
  }
};

struct Sum {
  Real value = 0, size = 0;
};

// Returns the sum of the products of rows a and b, and the sum of their absolute values.
Sum product(const Problem& p, std::size_t a, std::size_t b, bool weighted) {
  Sum sum;
  for (std::size_t k = 0; k < p.length; ++k) {
    const Real term =
        Real(p.rows[a * p.stride + k]) * p.rows[b * p.stride + k] * (weighted ? p.weights[k] : 1.0);
    sum.value += term;
    sum.size += std::abs(term);
  }
  return sum;
}

// Returns an entry of the matrix A, on either side of its diagonal.
Real entry(const std::vector<double>& matrix, std::size_t n, std::size_t i, std::size_t j) {
  return matrix[(1 + std::min(i, j)) * (n + 1) + 1 + std::max(i, j)];
}

// Compares the residual of the leading m of n equations with twice the bound of a backward stable
// Cholesky solution: (A + dA) x = b, |dA_ij| <= (3 m + 1) u sqrt(a_ii a_jj) (Higham 2002, Thm
// 10.4).
void expect_solution(const std::vector<double>& matrix, std::size_t n, std::size_t m,
                     const double* x) {
  for (std::size_t i = 0; i < m; ++i) {
    Real left = -Real(matrix[1 + i]), size = 0;
    for (std::size_t j = 0; j < m; ++j) {
      left += entry(matrix, n, i, j) * x[j];
      size += std::sqrt(entry(matrix, n, i, i) * entry(matrix, n, j, j)) * std::abs(x[j]);
    }
    const Real allowed = 2 * static_cast<Real>(3 * m + 1) * kUnit * size;
    ASSERT_LE(std::abs(left), allowed) << i << " of " << m << " of " << n;
  }
}

TEST(NormalEquations, rows_that_only_fill_a_group_of_four_are_cleared) {
  for (std::size_t count = 1; count <= 9; ++count) {
    const std::size_t stride = 16, whole = (count + 3) / 4 * 4;
    std::vector<double> rows((whole + 1) * stride, kNan);
    clear_beyond(rows.data(), count, stride);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const bool cleared = i >= count * stride && i < whole * stride;
      EXPECT_EQ(rows[i] == 0, cleared) << count << " rows, number " << i;
    }
  }
}

TEST(NormalEquations, matrix_is_the_sum_of_products) {
  test::for_each_target([](const char* target) {
    for (const std::size_t n : sizes_to_test()) {
      for (const bool weighted : {false, true}) {
        const Problem p(n, n % 3 * kCapLanes);
        const std::size_t count = n + 1;
        std::vector<double> set(count * count, kNan), added(count * count, 3.0);
        make_normal_matrix(p.all(weighted), set.data());
        add_normal_matrix(p.all(weighted), added.data());
        for (std::size_t a = 0; a <= n; ++a) {
          for (std::size_t b = a; b <= n; ++b) {
            const Sum sum = product(p, a, b, weighted);
            const auto terms = static_cast<Real>(p.length + 3);
            const std::size_t at = a * count + b;
            ASSERT_LE(std::abs(set[at] - sum.value), terms * kUnit * sum.size) << target << n;
            ASSERT_LE(std::abs(added[at] - (sum.value + 3)), terms * kUnit * (sum.size + 3))
                << target << n;
          }
        }
      }
    }
  });
}

TEST(NormalEquations, matrix_of_blocks_of_points_is_that_of_all_and_of_few_rows_the_leading_one) {
  test::for_each_target([](const char* target) {
    const Problem p(21, 0);
    const std::vector<double> all = p.matrix();
    const std::size_t count = 14;
    std::vector<double> leading(count * count, 0);
    for (std::size_t first = 0; first < p.length; first += kCapLanes) {
      add_normal_matrix(
          {p.rows.data() + first, count, kCapLanes, p.stride, p.weights.data() + first},
          leading.data());
    }
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = a; b < count; ++b) {
        EXPECT_NEAR(leading[a * count + b], all[a * (p.n + 1) + b], 1e-13) << target;
      }
    }
  });
}

TEST(NormalEquations, every_leading_block_is_solved) {
  test::for_each_target([](const char* target) {
    SCOPED_TRACE(target);
    NormalFactor factor;
    for (const std::size_t n : sizes_to_test()) {
      const std::vector<double> matrix = Problem(n, 0).matrix();
      ASSERT_EQ(factor.factor(matrix.data(), n, kLeast), n);
      for (std::size_t m = 0; m <= n; m += n > 33 && m > 0 ? n / 15 : 1) {
        std::vector<double> x(3, kNan);
        factor.solve(m, x);
        ASSERT_EQ(x.size(), m);
        expect_solution(matrix, n, m, x.data());
      }
    }
  });
}

TEST(NormalEquations, nested_blocks_are_solved_side_by_side) {
  test::for_each_target([](const char* target) {
    SCOPED_TRACE(target);
    NormalFactor factor;
    for (const std::size_t n : sizes_to_test()) {
      const std::vector<double> matrix = Problem(n, 0).matrix();
      ASSERT_EQ(factor.factor(matrix.data(), n, kLeast), n);
      for (const std::size_t step : {std::size_t{1}, std::size_t{5}, n}) {
        std::vector<std::size_t> sizes;
        for (std::size_t m = (n - 1) % step + 1; m <= n; m += step) sizes.push_back(m);
        std::vector<double> x(1, kNan);
        factor.solve_nested(sizes, x);
        ASSERT_EQ(x.size(), n * sizes.size());
        for (std::size_t s = 0; s < sizes.size(); ++s) {
          expect_solution(matrix, n, sizes[s], &x[s * n]);
          for (std::size_t i = sizes[s]; i < n; ++i) EXPECT_EQ(x[s * n + i], 0);
        }
      }
    }
  });
}

// A X = 1. One half of X mirrors the other half. The bound of each column therefore has the
// condition of the matrix as a factor, which is at most 100.
TEST(NormalEquations, inverse_times_matrix_is_one) {
  test::for_each_target([](const char* target) {
    NormalFactor factor;
    for (const std::size_t n : sizes_to_test()) {
      const std::vector<double> matrix = Problem(n, 0).matrix();
      ASSERT_EQ(factor.factor(matrix.data(), n, kLeast), n);
      for (const std::size_t m : {n, (n + 1) / 2}) {
        std::vector<double> inverse(1, kNan);
        factor.invert(m, inverse);
        ASSERT_EQ(inverse.size(), m * m);
        for (std::size_t i = 0; i < m; ++i) {
          for (std::size_t j = 0; j < m; ++j) {
            EXPECT_EQ(inverse[i * m + j], inverse[j * m + i]);
            Real left = i == j ? -1 : 0, size = 0;
            for (std::size_t k = 0; k < m; ++k) {
              const Real a = entry(matrix, n, i, k);
              left += a * inverse[k * m + j];
              size += std::sqrt(entry(matrix, n, i, i) * entry(matrix, n, k, k)) *
                      std::abs(inverse[k * m + j]);
            }
            ASSERT_LE(std::abs(left), 100 * static_cast<Real>(3 * m + 1) * kUnit * size)
                << target << " " << m << " of " << n;
          }
        }
      }
    }
  });
}

// Unknown `which` has twice the values of the first unknown, so that it has no pivot.
TEST(NormalEquations, unknowns_up_to_the_first_singular_one_are_factored) {
  test::for_each_target([](const char* target) {
    SCOPED_TRACE(target);
    for (const std::size_t n : sizes_to_test()) {
      for (const std::size_t which : {n / 3, n / 2, n - 1}) {
        if (which == 0) continue;
        Problem p(n, 0);
        for (std::size_t k = 0; k < p.length; ++k) {
          p.rows[(1 + which) * p.stride + k] = 2 * p.rows[p.stride + k];
        }
        const std::vector<double> matrix = p.matrix();
        NormalFactor factor;
        ASSERT_EQ(factor.factor(matrix.data(), n, kLeast), which);
        EXPECT_EQ(factor.regular(), which);
        std::vector<double> x;
        factor.solve(which, x);
        expect_solution(matrix, n, which, x.data());
      }
    }
  });
}

TEST(NormalEquations, zeros_and_what_is_no_number_have_no_pivot) {
  test::for_each_target([](const char* target) {
    for (const double bad : {0.0, -1.0, 1e-310, kNan}) {
      for (std::size_t which = 0; which < 9; ++which) {
        std::vector<double> matrix = Problem(9, 0).matrix();
        matrix[normal_diagonal(which, 9)] = bad;
        EXPECT_EQ(NormalFactor().factor(matrix.data(), 9, kLeast), which) << target << bad;
      }
    }
  });
}

// [1 c; c 1] has the second pivot 1 - c^2.
TEST(NormalEquations, a_pivot_is_compared_with_its_diagonal_element) {
  test::for_each_target([](const char* target) {
    for (const double pivot : {1e-2, 1e-6, 1e-10}) {
      for (const double scale : {1e-100, 1.0, 1e100}) {
        const double c = std::sqrt(1 - pivot) * scale;
        const std::vector<double> matrix = {0, scale, scale, kNan, scale, c, kNan, kNan, scale};
        EXPECT_EQ(NormalFactor().factor(matrix.data(), 2, 0.999 * pivot), 2U) << target;
        EXPECT_EQ(NormalFactor().factor(matrix.data(), 2, 1.001 * pivot), 1U) << target;
      }
    }
  });
}

TEST(NormalEquations, memory_that_was_used_gives_the_same_bits) {
  test::for_each_target([](const char* target) {
    NormalFactor used;
    for (std::size_t n = 1; n <= 33; ++n) {
      const std::vector<double> large = Problem(45, 0).matrix(), matrix = Problem(n, 0).matrix();
      std::vector<double> x, inverse, expected;
      ASSERT_EQ(used.factor(large.data(), 45, kLeast), 45U);
      used.invert(45, inverse);
      ASSERT_EQ(used.factor(matrix.data(), n, kLeast), n);
      NormalFactor fresh;
      ASSERT_EQ(fresh.factor(matrix.data(), n, kLeast), n);
      used.solve(n, x);
      fresh.solve(n, expected);
      EXPECT_EQ(x, expected) << target << n;
      const std::vector<std::size_t> sizes = {(n + 1) / 2, n};
      used.solve_nested(sizes, x);
      fresh.solve_nested(sizes, expected);
      EXPECT_EQ(x, expected) << target << n;
      used.invert(n, inverse);
      fresh.invert(n, expected);
      EXPECT_EQ(inverse, expected) << target << n;
    }
  });
}

}  // namespace
}  // namespace rholm
