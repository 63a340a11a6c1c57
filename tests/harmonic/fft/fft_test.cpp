#include "harmonic/fft/fft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/aligned_array.h"

namespace rholm {
namespace {

TEST(Fft, lengths_have_only_the_factors_two_and_five) {
  EXPECT_EQ(smooth_length(1), 1u);
  EXPECT_EQ(smooth_length(7), 8u);
  EXPECT_EQ(smooth_length(11), 16u);
  EXPECT_EQ(smooth_length(514), 640u);
  EXPECT_EQ(smooth_length(962, 4), 1024u);
  EXPECT_EQ(smooth_length(3, 8), 8u);
}

// A Kronecker delta at j = 1 has the transform e^{-2 pi i k/n}; the way back multiplies by n.
template <typename T>
void expect_shifted_delta(std::size_t n) {
  AlignedArray<T> row(n + 2), work(n + 2);
  std::fill(row.begin(), row.end(), T{0});
  row[1] = 1;
  const RealFft<T> fft(n);
  fft.forward(row.data(), n / 2 + 1, work.data());
  const double eps = 8 * std::numeric_limits<T>::epsilon();
  for (std::size_t k = 0; k <= n / 2; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
    EXPECT_NEAR(row[2 * k], std::cos(angle), eps);
    EXPECT_NEAR(row[2 * k + 1], -std::sin(angle), eps);
  }
}

// Wave k comes back doubled, because of k and -k; the constant comes back once.
template <typename T>
void expect_waves(std::size_t n) {
  AlignedArray<T> row(n + 2), work(n + 2);
  std::fill(row.begin(), row.end(), T{0});
  row[0] = 3;
  row[2 * 2] = T(0.5);
  row[2 * 2 + 1] = T(0.25);
  RealFft<T>(n).backward(row.data(), 4, work.data());
  for (std::size_t j = 0; j < n; ++j) {
    const double angle = 4 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(n);
    EXPECT_NEAR(row[j], 3 + std::cos(angle) - 0.5 * std::sin(angle),
                16 * std::numeric_limits<T>::epsilon());
  }
}

TEST(Fft, of_a_shifted_delta_is_a_wave) {
  expect_shifted_delta<float>(40);
  expect_shifted_delta<double>(40);
  expect_shifted_delta<double>(26);
}

TEST(Fft, backward_sums_waves) {
  expect_waves<float>(40);
  expect_waves<double>(24);
}

TEST(Fft, of_one_complex_wave_is_one_coefficient) {
  const std::size_t n = 60;
  AlignedArray<double> in(2 * n), out(2 * n);
  for (std::size_t j = 0; j < n; ++j) {
    const double angle = 2 * std::numbers::pi * 7 * static_cast<double>(j) / n;
    in[2 * j] = std::cos(angle);
    in[2 * j + 1] = std::sin(angle);
  }
  ComplexFft<double>(n).forward(reinterpret_cast<std::complex<double>*>(in.data()),
                                reinterpret_cast<std::complex<double>*>(out.data()));
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_NEAR(out[2 * k], k == 7 ? n : 0, 1e-13 * n);
    EXPECT_NEAR(out[2 * k + 1], 0, 1e-13 * n);
  }
}

}  // namespace
}  // namespace rholm
