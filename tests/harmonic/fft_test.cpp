#include "harmonic/fft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/aligned_array.h"

namespace rholm {
namespace {

TEST(Fft, lengths_have_only_the_factors_two_three_and_five) {
  EXPECT_EQ(smooth_length(1), 1u);
  EXPECT_EQ(smooth_length(7), 8u);
  EXPECT_EQ(smooth_length(514), 540u);
  EXPECT_EQ(smooth_length(963, 4), 972u);
  EXPECT_EQ(smooth_length(3, 8), 8u);
}

// A Kronecker delta at j = 1 has the transform e^{-2 pi i k/n}, and comes back n times itself.
template <typename T>
void expect_shifted_delta(std::size_t n) {
  AlignedArray<T> row(RealFft<T>::row_size(n));
  std::fill(row.begin(), row.end(), T{0});
  row[1] = 1;
  const RealFft<T> fft(n);
  fft.forward(row.data());
  const double eps = 8 * std::numeric_limits<T>::epsilon();
  for (std::size_t k = 0; k <= n / 2; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
    EXPECT_NEAR(row[2 * k], std::cos(angle), eps);
    EXPECT_NEAR(row[2 * k + 1], -std::sin(angle), eps);
  }
  fft.backward(row.data());
  for (std::size_t j = 0; j < n; ++j) {
    EXPECT_NEAR(row[j], j == 1 ? static_cast<double>(n) : 0.0, eps * static_cast<double>(n));
  }
}

TEST(Fft, of_a_shifted_delta_is_a_wave) {
  expect_shifted_delta<float>(40);
  expect_shifted_delta<double>(40);
  expect_shifted_delta<double>(27);
}

TEST(Fft, complex_both_ways_multiplies_by_the_length) {
  const std::size_t n = 60;
  AlignedArray<double> data(2 * n);
  auto* row = reinterpret_cast<std::complex<double>*>(data.data());
  for (std::size_t j = 0; j < n; ++j) {
    const double x = static_cast<double>(j);
    row[j] = {std::sin(0.7 * x), std::cos(1.3 * x * x)};
  }
  const std::vector<std::complex<double>> before(row, row + n);
  const ComplexFft fft(n);
  fft.forward(row);
  std::complex<double> first = 0;
  for (const auto& value : before) first += value;
  EXPECT_LT(std::abs(row[0] - first), 1e-13);
  fft.backward(row);
  for (std::size_t j = 0; j < n; ++j) {
    EXPECT_LT(std::abs(row[j] - static_cast<double>(n) * before[j]), 1e-13 * n);
  }
}

}  // namespace
}  // namespace rholm
