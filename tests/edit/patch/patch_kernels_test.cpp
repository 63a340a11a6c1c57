#include "edit/patch/patch_kernels.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "harmonic/legendre/low_harmonics.h"
#include "rholm/harmonic.h"
#include "support/targets.h"

namespace rholm {
namespace {

// Rows and weights of a well-posed least squares of n unknowns, the first row its right-hand side;
// its normal equations by a plain sum.
struct Equations {
  std::size_t n, n_points = 96;
  std::vector<double> rows, weights, matrix;
  explicit Equations(std::size_t unknowns)
      : n(unknowns), rows((n + 5) * n_points), weights(n_points), matrix((n + 1) * (n + 1)) {
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = random_uniform(1, i) - 0.5;
    for (std::size_t i = 0; i < n_points; ++i) weights[i] = 0.5 + random_uniform(2, i);
    for (std::size_t a = 0; a <= n; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        for (std::size_t i = 0; i < n_points; ++i) {
          matrix[a * (n + 1) + b] += weights[i] * rows[a * n_points + i] * rows[b * n_points + i];
        }
      }
    }
  }
};

TEST(PatchKernels, gram_of_blocks_is_the_sum_over_all_points) {
  test::for_each_target([](const char* target) {
    SCOPED_TRACE(target);
    const Equations e(patch_basis(4));
    std::vector<double> matrix(e.matrix.size(), 0);
    for (std::size_t first = 0; first < e.n_points; first += 32) {
      std::vector<double> block;
      for (std::size_t row = 0; row < e.n + 5; ++row) {
        const auto from = e.rows.begin() + static_cast<std::ptrdiff_t>(row * e.n_points + first);
        block.insert(block.end(), from, from + 32);
      }
      patch_gram(block.data(), e.n + 1, &e.weights[first], 32, matrix.data());
    }
    for (std::size_t a = 0; a <= e.n; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        EXPECT_NEAR(matrix[a * (e.n + 1) + b], e.matrix[a * (e.n + 1) + b], 1e-13);
      }
    }
  });
}

// 1 ... 33 rows, of 8 ... 40 points; rows beyond the last hold anything.
TEST(PatchKernels, sums_of_any_number_of_rows_are_plain_sums) {
  test::for_each_target([](const char* target) {
    for (std::size_t count = 1; count <= 33; ++count) {
      const std::size_t n = padded(count);
      std::vector<double> rows((count + 4) * n, std::nan("")), weights(n), coefficients(count);
      for (std::size_t i = 0; i < count * n; ++i) rows[i] = random_uniform(5, i) - 0.5;
      for (std::size_t i = 0; i < n; ++i) weights[i] = i < count ? random_uniform(6, i) : 0;
      for (std::size_t k = 0; k < count; ++k) coefficients[k] = random_uniform(7, k);
      std::vector<double> matrix(count * count, 1.0), out(n, std::nan(""));
      patch_gram(rows.data(), count, weights.data(), n, matrix.data());
      patch_sum(rows.data(), coefficients.data(), count, n, out.data());
      for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
          double sum = 1;
          for (std::size_t i = 0; i < n; ++i) sum += weights[i] * rows[a * n + i] * rows[b * n + i];
          EXPECT_NEAR(matrix[a * count + b], sum, 1e-13) << target << " " << count;
        }
      }
      for (std::size_t i = 0; i < n; ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < count; ++k) sum += coefficients[k] * rows[k * n + i];
        EXPECT_NEAR(out[i], sum, 1e-13) << target << " " << count;
      }
    }
  });
}

// Columns stand for themselves: those of a block of eight are those of longer ones.
TEST(PatchKernels, rows_at_a_point_do_not_depend_on_those_beside_it) {
  const CapFrame frame{.center = {0, 0, -1},
                       .x = {1, 0, 0},
                       .y = {0, 1, 0},
                       .z = {0, 0, 1},
                       .radius = 1,
                       .dilation = 2,
                       .support = 0.5};
  const int degree = 8;
  const std::size_t count = patch_basis(degree) + 1, most = 40;
  test::for_each_target([&](const char* target) {
    const auto rows_of = [&](std::size_t first, std::size_t n) {
      std::vector<double> offsets(3 * n), rows(count * n, std::nan("")), area(n, std::nan(""));
      for (std::size_t i = 0; i < 3 * n; ++i) {
        offsets[i] = 0.4 * (random_uniform(8, (i / n) * most + first + i % n) - 0.5);
      }
      patch_rows(frame, degree, offsets.data(), n, rows.data(), area.data());
      rows.insert(rows.end(), area.begin(), area.end());
      return rows;
    };
    for (std::size_t n = kPatchLanes; n <= most; n += kPatchLanes) {
      const std::vector<double> all = rows_of(0, n), last = rows_of(n - kPatchLanes, kPatchLanes);
      for (std::size_t row = 0; row <= count; ++row) {
        for (std::size_t i = 0; i < kPatchLanes; ++i) {
          EXPECT_EQ(all[row * n + n - kPatchLanes + i], last[row * kPatchLanes + i]) << target;
        }
      }
    }
  });
}

TEST(PatchKernels, family_solves_the_leading_equations_of_each_degree) {
  test::for_each_target([](const char* target) {
    SCOPED_TRACE(target);
    for (const int degree : {0, 1, 3, 8, 9}) {
      const Equations e(patch_basis(degree));
      const std::size_t n = e.n, sets = padded(static_cast<std::size_t>(degree) + 1);
      std::vector<double> upper(n * padded(n + 1)), x(n * sets);
      ASSERT_TRUE(patch_factorize(e.matrix.data(), n, 1e-12, upper.data()));
      patch_family(upper.data(), degree, x.data());
      for (int d = 0; d <= degree; ++d) {
        for (std::size_t a = 0; a < n; ++a) {
          const std::size_t at = static_cast<std::size_t>(d);
          if (a >= patch_basis(d)) {
            EXPECT_EQ(x[a * sets + at], 0);
            continue;
          }
          double left = -e.matrix[(a + 1) * (n + 1)];
          for (std::size_t b = 0; b < patch_basis(d); ++b) {
            const std::size_t row = std::max(a, b) + 1, column = std::min(a, b) + 1;
            left += e.matrix[row * (n + 1) + column] * x[b * sets + at];
          }
          EXPECT_NEAR(left, 0, 1e-12) << degree << " " << d << " " << a;
        }
      }
    }
  });
}

TEST(PatchKernels, lost_pivot_is_told) {
  test::for_each_target([](const char* target) {
    SCOPED_TRACE(target);
    Equations e(patch_basis(2));
    const std::size_t last = e.n * (e.n + 1);  // its last row becomes twice its first
    for (std::size_t k = 1; k < e.n; ++k) {
      e.matrix[last + k] = 2 * e.matrix[k * (e.n + 1) + 1];
    }
    e.matrix[last + e.n] = 4 * e.matrix[e.n + 2];
    std::vector<double> upper(e.n * padded(e.n + 1));
    EXPECT_FALSE(patch_factorize(e.matrix.data(), e.n, 1e-12, upper.data()));
  });
}

TEST(PatchKernels, sums_of_all_degrees_are_those_of_one_after_the_other) {
  test::for_each_target([](const char* target) {
    SCOPED_TRACE(target);
    for (int degree = 0; degree <= 9; ++degree) {
      const std::size_t count = patch_basis(degree), n = 16;
      const std::size_t sets = static_cast<std::size_t>(degree) + 1;
      std::vector<double> rows(count * n), coefficients(count * sets, 0), one(n), all(sets * n);
      for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = random_uniform(3, i);
      for (int d = 0; d <= degree; ++d) {
        for (std::size_t k = 0; k < patch_basis(d); ++k) {
          const std::size_t at = static_cast<std::size_t>(d) * count + k;
          coefficients[at] = random_uniform(4, at);
        }
      }
      patch_sums(rows.data(), coefficients.data(), degree, n, all.data(), n);
      for (int d = 0; d <= degree; ++d) {
        const auto at = static_cast<std::size_t>(d);
        patch_sum(rows.data(), &coefficients[at * count], patch_basis(d), n, one.data());
        for (std::size_t i = 0; i < n; ++i)
          EXPECT_EQ(all[at * n + i], one[i]) << degree << " " << d;
      }
    }
  });
}

TEST(PatchKernels, what_is_nearer_than_the_radius_is_silent) {
  test::for_each_target([](const char* target) {
    SCOPED_TRACE(target);
    const std::size_t n = 8;
    std::vector<double> offsets(3 * n, 0), weights(n, 2);
    for (std::size_t i = 0; i < n; ++i) offsets[i] = static_cast<double>(i);
    const double at[3] = {2, 0, 0};
    patch_silence(offsets.data(), n, at, 1.5, weights.data());
    EXPECT_EQ(weights, (std::vector<double>{2, 0, 0, 0, 2, 2, 2, 2}));
  });
}

}  // namespace
}  // namespace rholm
