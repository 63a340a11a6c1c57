#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "harmonic/legendre/legendre_kernels.h"
#include "rholm/harmonic.h"

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<double> row_at(int m, int degree, double theta) {
  const LegendreOrder order = legendre_order(m, degree, legendre_mu(degree)[m]);
  return legendre_row(order, std::cos(theta), std::sin(theta));
}

TEST(legendre_row, agrees_with_the_closed_forms_of_low_degrees) {
  for (const double theta : {0.0, 1e-12, 0.3, 1.0, kPi / 2, 2.5, kPi}) {
    const double x = std::cos(theta), s = std::sin(theta);
    const auto p0 = row_at(0, 3, theta), p1 = row_at(1, 3, theta), p2 = row_at(2, 3, theta),
               p3 = row_at(3, 3, theta);
    EXPECT_NEAR(p0[0], std::sqrt(1 / (4 * kPi)), 1e-15);
    EXPECT_NEAR(p0[1], std::sqrt(3 / (4 * kPi)) * x, 1e-15);
    EXPECT_NEAR(p0[2], std::sqrt(5 / (16 * kPi)) * (3 * x * x - 1), 1e-15);
    EXPECT_NEAR(p0[3], std::sqrt(7 / (16 * kPi)) * (5 * x * x * x - 3 * x), 2e-15);
    EXPECT_NEAR(p1[0], std::sqrt(3 / (4 * kPi)) * s, 1e-15);
    EXPECT_NEAR(p1[1], std::sqrt(15 / (4 * kPi)) * s * x, 1e-15);
    EXPECT_NEAR(p1[2], std::sqrt(21 / (32 * kPi)) * s * (5 * x * x - 1), 2e-15);
    EXPECT_NEAR(p2[0], std::sqrt(15 / (16 * kPi)) * s * s, 1e-15);
    EXPECT_NEAR(p2[1], std::sqrt(105 / (16 * kPi)) * s * s * x, 2e-15);
    EXPECT_NEAR(p3[0], std::sqrt(35 / (32 * kPi)) * s * s * s, 1e-15);
  }
}

// sum_m Y_lm(u)^2 = (2l+1)/(4 pi) in every direction; at phi = 0 only cosine terms remain.
TEST(legendre_row, addition_theorem_holds_to_degree_2000_at_every_colatitude) {
  constexpr int L = 2000;
  const std::vector<double> mu = legendre_mu(L);
  for (const double theta :
       {0.0, 1e-300, 1e-12, 1e-6, 1e-3, 0.01, 0.1, 0.5, 1.0, kPi / 2, 2.0, 3.0, kPi - 1e-5, kPi}) {
    std::vector<double> sum(L + 1, 0.0);
    for (int m = 0; m <= L; ++m) {
      const LegendreOrder order = legendre_order(m, L, mu[m]);
      const auto row = legendre_row(order, std::cos(theta), std::sin(theta));
      for (int l = m; l <= L; ++l) {
        ASSERT_TRUE(std::isfinite(row[l - m]));
        // Sine and cosine terms have the same Pt. Sine terms vanish at phi = 0; averaged over phi,
        // both share the sum: (cos^2 + sin^2) Pt^2 = Pt^2.
        sum[l] += row[l - m] * row[l - m];
      }
    }
    for (int l = 0; l <= L; ++l) {
      // Rounding of sin theta gives m eps/2, twice for the square; the recurrence gives l eps/2.
      // The sum is 3 l eps/2; the bound adds room for the accumulation.
      EXPECT_NEAR(sum[l] / ((2 * l + 1) / (4 * kPi)), 1, 1e-15 * (4 + l)) << l << " " << theta;
    }
  }
}

// Long double has 11 more bits of mantissa and exponents to 1e-4932, so that the same recurrence
// needs no scaling for the colatitudes below.
TEST(legendre_row, agrees_with_a_recurrence_in_extended_precision_at_degree_2000) {
  constexpr int L = 2000;
  const std::vector<double> mu = legendre_mu(L);
  for (const double theta : {0.02, 0.2, 0.7, 1.5, kPi - 0.05}) {
    const double x = std::cos(theta), s = std::sin(theta);
    for (const int m : {0, 1, 2, 17, 100, 500, 1000, 1500, 1900, 1999, 2000}) {
      const auto row = legendre_row(legendre_order(m, L, mu[m]), x, s);
      // The argument in extended precision, from cos or sin, whichever determines it better.
      const long double exact_x =
          std::abs(x) < s ? x : std::copysign(std::sqrt(1 - static_cast<long double>(s) * s), x);
      long double p0 = 0, p1 = std::sqrt(1 / (4 * std::numbers::pi_v<long double>));
      if (m > 0) p1 *= std::sqrt(2.0L);
      for (int k = 1; k <= m; ++k) p1 *= s * std::sqrt((2.0L * k + 1) / (2.0L * k));
      long double largest = 0;
      for (int l = m; l <= L; ++l) {
        largest = std::max(largest, std::abs(p1));
        // Errors are relative to the largest value of the row so far: near zeros they are absolute.
        EXPECT_NEAR(row[l - m], static_cast<double>(p1),
                    static_cast<double>(largest) * 1e-15 * (4 + l) + 1e-140)
            << l << " " << m << " " << theta;
        const long double ll = l, mm = m, next = (ll + 1) * (ll + 1) - mm * mm;
        const long double p2 =
            std::sqrt((2 * ll + 1) * (2 * ll + 3) / next) * exact_x * p1 -
            (l == m ? 0
                    : std::sqrt((2 * ll + 3) * (ll * ll - mm * mm) / ((2 * ll - 1) * next)) * p0);
        p0 = p1;
        p1 = p2;
      }
    }
  }
}

TEST(gauss_legendre, integrates_polynomials_of_degree_2n_minus_1_exactly) {
  for (const int n : {1, 2, 3, 4, 5, 16, 63, 64, 200, 1000}) {
    const GaussRule rule = gauss_legendre(n);
    for (const int degree : {0, 1, 2, n, 2 * n - 2, 2 * n - 1}) {
      if (degree > 2 * n - 1) continue;
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
      EXPECT_NEAR(sum, degree % 2 ? 0.0 : 2.0 / (degree + 1), 5e-15) << n << " " << degree;
    }
  }
}

}  // namespace
}  // namespace rholm
