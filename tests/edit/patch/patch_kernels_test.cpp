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

TEST(PatchKernels, sums_of_any_number_of_rows_are_plain_sums) {
  test::for_each_target([](const char* target) {
    for (std::size_t count = 1; count <= 33; ++count) {
      const std::size_t n = padded(count);
      std::vector<double> rows(count * n), coefficients(count);
      for (std::size_t i = 0; i < count * n; ++i) rows[i] = random_uniform(5, i) - 0.5;
      for (std::size_t k = 0; k < count; ++k) coefficients[k] = random_uniform(7, k);
      std::vector<double> out(n, std::nan(""));
      patch_sum(rows.data(), coefficients.data(), count, n, out.data());
      for (std::size_t i = 0; i < n; ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < count; ++k) sum += coefficients[k] * rows[k * n + i];
        EXPECT_NEAR(out[i], sum, 1e-13) << target << " " << count;
      }
    }
  });
}

// Columns are independent: columns of a block of eight equal the ones of longer blocks.
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
    for (std::size_t n = kCapLanes; n <= most; n += kCapLanes) {
      const std::vector<double> all = rows_of(0, n), last = rows_of(n - kCapLanes, kCapLanes);
      for (std::size_t row = 0; row <= count; ++row) {
        for (std::size_t i = 0; i < kCapLanes; ++i) {
          EXPECT_EQ(all[row * n + n - kCapLanes + i], last[row * kCapLanes + i]) << target;
        }
      }
    }
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

TEST(PatchKernels, weights_within_the_radius_become_zero) {
  test::for_each_target([](const char* target) {
    SCOPED_TRACE(target);
    const std::size_t n = 8;
    std::vector<double> offsets(3 * n, 0), weights(n, 2);
    for (std::size_t i = 0; i < n; ++i) offsets[i] = static_cast<double>(i);
    const double at[3] = {2, 0, 0};
    zero_weights_within(offsets.data(), n, at, 1.5, weights.data());
    EXPECT_EQ(weights, (std::vector<double>{2, 0, 0, 0, 2, 2, 2, 2}));
  });
}

}  // namespace
}  // namespace rholm
