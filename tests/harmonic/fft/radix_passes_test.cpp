// Compares with long double sums for all short lengths, and with FFTW for all lengths of plans.
#include "harmonic/fft/radix_passes.h"

#include <fftw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "base/aligned_array.h"
#include "harmonic/fft/chirp_plan.h"
#include "harmonic/fft/fft.h"
#include "support/random_data.h"

namespace rholm {
namespace {

using Long = std::complex<long double>;

template <typename T>
std::vector<std::complex<T>> random_row(std::size_t n) {
  const std::vector<double> parts = test::random_values(2 * n, n);
  std::vector<std::complex<T>> row(n);
  for (std::size_t j = 0; j < n; ++j) {
    row[j] = {static_cast<T>(parts[2 * j]), static_cast<T>(parts[2 * j + 1])};
  }
  return row;
}

// Transforms a row by its plan, in memory that was filled with NaN.
template <typename T>
std::vector<std::complex<T>> transformed(const std::vector<std::complex<T>>& row) {
  const std::size_t n = row.size();
  AlignedArray<std::complex<T>> in(n), out(n);
  std::copy(row.begin(), row.end(), in.begin());
  if (is_radix_length(n)) {
    run_radix_plan(make_radix_plan<T>(n), in.data(), out.data());
  } else {
    run_chirp_plan(make_chirp_plan<T>(n), in.data(), out.data());
  }
  return {out.begin(), out.end()};
}

// Returns X_k = sum_j x_j w^(j k), with the powers of w from a table.
template <typename T>
std::vector<Long> direct_sums(const std::vector<std::complex<T>>& row) {
  const std::size_t n = row.size();
  std::vector<Long> powers(n), sums(n);
  for (std::size_t j = 0; j < n; ++j) {
    const long double angle = 2 * std::numbers::pi_v<long double> * static_cast<long double>(j) /
                              static_cast<long double>(n);
    powers[j] = {std::cos(angle), -std::sin(angle)};
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t j = 0; j < n; ++j) sums[k] += Long(row[j]) * powers[j * k % n];
  }
  return sums;
}

// Compares whole rows in the l2 norm. Each of some log2 n passes of radix 2 makes at most about 7
// roundings of eps / 2 each, which partly cancel (Higham, Accuracy and Stability of Numerical
// Algorithms, 2nd ed., theorem 24.2). Rows here use up to 0.29 of the bound with every instruction
// set, and 0.86 where three transforms of twice the length make one.
template <typename T, typename Other>
void expect_equal(const std::vector<std::complex<T>>& found, const std::vector<Other>& right) {
  long double error = 0, norm = 0;
  for (std::size_t k = 0; k < right.size(); ++k) {
    error += std::norm(Long(found[k]) - Long(right[k]));
    norm += std::norm(Long(right[k]));
  }
  const double allowed = (1 + std::log2(static_cast<double>(right.size()))) *
                         static_cast<double>(std::numeric_limits<T>::epsilon());
  EXPECT_LE(static_cast<double>(std::sqrt(error / norm)), allowed) << right.size();
}

template <typename T>
void expect_direct_sums(std::size_t n) {
  const std::vector<std::complex<T>> row = random_row<T>(n);
  expect_equal(transformed(row), direct_sums(row));
}

void transform_by_fftw(std::vector<std::complex<double>>& row) {
  auto* const data = reinterpret_cast<fftw_complex*>(row.data());
  fftw_plan plan =
      fftw_plan_dft_1d(static_cast<int>(row.size()), data, data, FFTW_FORWARD, FFTW_ESTIMATE);
  fftw_execute(plan);
  fftw_destroy_plan(plan);
}

TEST(radix_passes, are_the_direct_sums_for_every_length_of_small_factors) {
  std::size_t lengths = 0;
  for (std::size_t n = 1; n <= 500; ++n) {
    if (!is_radix_length(n)) continue;
    ++lengths;
    expect_direct_sums<float>(n);
    expect_direct_sums<double>(n);
  }
  EXPECT_EQ(lengths, 67u);  // OEIS A051037 up to 500
}

// Lengths of grids that other programs choose, for example 2 L + 1 columns.
TEST(chirp_plan, gives_the_direct_sums_for_every_other_length) {
  for (std::size_t n = 1; n <= 260; ++n) {
    if (is_radix_length(n)) continue;
    expect_direct_sums<float>(n);
    expect_direct_sums<double>(n);
  }
}

TEST(chirp_plan, gives_that_of_fftw_for_long_primes) {
  for (const std::size_t n : {8191u, 32749u}) {
    const std::vector<std::complex<double>> row = random_row<double>(n);
    std::vector<std::complex<double>> right = row;
    transform_by_fftw(right);
    expect_equal(transformed(row), right);
  }
}

// Lengths that smooth_length() returns up to the grids of kMaxDegree, and half lengths.
TEST(radix_passes, are_those_of_fftw_for_every_length_of_a_plan) {
  for (const std::size_t odd : {1, 5, 25}) {
    for (std::size_t n = odd; n <= 100000; n *= 2) {
      const std::vector<std::complex<double>> row = random_row<double>(n);
      std::vector<std::complex<double>> right = row;
      transform_by_fftw(right);
      expect_equal(transformed(row), right);
      const std::vector<std::complex<float>> single = random_row<float>(n);
      std::vector<std::complex<double>> right_of_single(single.begin(), single.end());
      transform_by_fftw(right_of_single);
      expect_equal(transformed(single), right_of_single);
    }
  }
}

// Each input value contributes to each output value: one wave per row.
TEST(radix_passes, of_each_wave_are_one_number) {
  for (const std::size_t n : {24u, 80u, 100u, 135u}) {
    for (std::size_t wave = 0; wave < n; ++wave) {
      std::vector<std::complex<double>> row(n), right(n);
      for (std::size_t j = 0; j < n; ++j) {
        row[j] = std::polar(
            1.0, 2 * std::numbers::pi * static_cast<double>(wave * j % n) / static_cast<double>(n));
      }
      right[wave] = static_cast<double>(n);
      expect_equal(transformed(row), right);
    }
  }
}

TEST(radix_passes, lengths_have_no_other_factors) {
  EXPECT_TRUE(is_radix_length(1));
  EXPECT_TRUE(is_radix_length(2 * 2 * 3 * 5 * 5));
  EXPECT_FALSE(is_radix_length(0));
  EXPECT_FALSE(is_radix_length(7));
  EXPECT_FALSE(is_radix_length(2 * 11));
}

// All threads share a plan: the result of a row does not depend on rows transformed before.
TEST(radix_passes, give_the_same_bits_again) {
  const std::vector<std::complex<float>> row = random_row<float>(400);
  const auto first = transformed(row);
  (void)transformed(random_row<float>(1024));
  EXPECT_EQ(transformed(row), first);
}

}  // namespace
}  // namespace rholm
