#include "harmonic/rings/ring_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "harmonic/legendre/legendre_kernels.h"
#include "rholm/harmonic.h"
#include "support/random_data.h"
#include "support/targets.h"

namespace rholm {
namespace {

using test::inner;
using test::random_values;

constexpr double kPi = std::numbers::pi;

// Returns rings of a grid, with a pole, a ring on the equator, and rings very near to both.
std::vector<double> some_colatitudes(int degree) {
  std::vector<double> theta = {0, 1e-300, 1e-9, 1e-3 / (degree + 1)};
  const GaussRule rule = gauss_legendre(degree + 1);
  for (int i = 0; 2 * i <= degree; ++i) theta.push_back(std::acos(rule.nodes[i]));
  for (const double distance : {1e-3 / (degree + 1), 1e-9, 0.0}) {
    theta.push_back(kPi / 2 - distance);
  }
  return theta;
}

// even_re, even_im, odd_re, odd_im.
struct Rows {
  explicit Rows(const HalfRings& rings, std::uint64_t seed = 0) {
    for (std::size_t part = 0; part < 4; ++part) {
      if (seed != 0) values[part] = random_values(rings.size, seed + part);
      values[part].resize(rings.padded, 0.0);
    }
  }
  std::vector<double> values[4];
};

struct Pair {
  std::vector<double> c, s;
};

RingOrder order_of(int m, int degree) {
  RingOrder order;
  set_ring_order(RingTables(degree), m, order);
  return order;
}

Pair adjoint(const RingOrder& order, const HalfRings& rings, const Rows& rows) {
  const std::size_t n = static_cast<std::size_t>(order.degree - order.m) + 1;
  Pair result{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  ring_adjoint(order, rings, rows.values[0].data(), rows.values[1].data(), rows.values[2].data(),
               rows.values[3].data(), result.c.data(), result.s.data());
  return result;
}

Rows forward(const RingOrder& order, const HalfRings& rings, const Pair& coefficients) {
  Rows rows(rings);
  ring_forward(order, rings, coefficients.c.data(), coefficients.s.data(), rows.values[0].data(),
               rows.values[1].data(), rows.values[2].data(), rows.values[3].data());
  return rows;
}

// Returns values on single rings, [ring][l - m], from the adjoint of unit vectors. Parts do not
// mix: even and odd degrees, real and imaginary parts.
std::vector<std::vector<double>> values_on_rings(const RingOrder& order, const HalfRings& rings) {
  std::vector<std::vector<double>> values;
  for (std::size_t i = 0; i < rings.size; ++i) {
    Rows rows(rings);
    rows.values[0][i] = rows.values[2][i] = 1;
    values.push_back(adjoint(order, rings, rows).c);
  }
  return values;
}

// Returns the largest error of both directions against legendre_row(), relative to the largest
// value. In the forward direction the sine sums are twice the cosine sums.
double worst_error(int m, int degree, const std::vector<double>& colatitudes) {
  const HalfRings rings(colatitudes);
  const RingOrder order = order_of(m, degree);
  const LegendreOrder oracle = legendre_order(m, degree, order.mu);
  const auto values = values_on_rings(order, rings);
  const std::size_t n = values[0].size();
  double largest = 0, error = 0;
  const auto look = [&](double value, double expected, double scale) {
    EXPECT_TRUE(std::isfinite(value));
    error = std::max(error, std::abs(value - expected) / scale);
  };
  const Pair ones{std::vector<double>(n, 1.0), std::vector<double>(n, 2.0)};
  const Rows rows = forward(order, rings, ones);
  for (std::size_t i = 0; i < rings.size; ++i) {
    const auto row = legendre_row(oracle, rings.cos_theta[i], rings.sin_theta[i]);
    double even = 0, odd = 0, size = 0;
    for (std::size_t l = 0; l < n; ++l) {
      largest = std::max(largest, std::abs(row[l]));
      look(values[i][l], row[l], 1);
      (l % 2 == 0 ? even : odd) += row[l];
      size += std::abs(row[l]);
    }
    const double scale = std::max(size, 1e-3);
    look(rows.values[0][i], even, scale);
    look(rows.values[1][i], 2 * even, 2 * scale);
    look(rows.values[2][i], odd, scale);
    look(rows.values[3][i], 2 * odd, 2 * scale);
  }
  return error / std::max(largest, 1e-3);
}

TEST(ring_sums, agree_with_legendre_row_at_every_colatitude) {
  for (const int degree : {0, 1, 2, 3, 8, 63, 64, 130, 256, 601}) {
    for (const int m : {0, 1, 2, 3, 17, 40, 63, 64, 129, 255, 500, 600, 601}) {
      if (m > degree) continue;
      // The error is measured at most 9e-14, with L = 256.
      EXPECT_LT(worst_error(m, degree, some_colatitudes(degree)), 2e-13) << degree << " " << m;
    }
  }
}

TEST(ring_sums, agree_with_legendre_row_at_degree_4096) {
  constexpr int L = 4096;
  const std::vector<double> theta = {1e-5,  0.0005, 0.003, 0.02, 0.0614,         0.1,
                                     0.5,   1.0,    1.3,   1.55, kPi / 2 - 3e-4, kPi / 2,
                                     1.567, 1.5692, 1.5};
  for (const int m : {0, 1, 2, 10, 100, 399, 1000, 2048, 3500, 4000, 4095, 4096}) {
    // The bound is twice the measured error.
    EXPECT_LT(worst_error(m, L, theta), 3e-13) << m;
  }
}

// In long double the same recurrence has exponents to 2^-16382, far below any value that matters.
TEST(ring_sums, agree_with_extended_precision_at_degree_16384) {
  constexpr int L = 16384;
  for (const double theta : {0.9, 1.2, 1.5}) {
    const long double x = std::cos(static_cast<long double>(theta));
    const long double s = std::sin(static_cast<long double>(theta));
    for (const int m : {3, 9000, 12000, 16000, 16384}) {
      const HalfRings rings(std::vector<double>{theta});
      const RingOrder order = order_of(m, L);
      const auto row = values_on_rings(order, rings)[0];
      long double p1 = std::sqrt(1 / (4 * std::numbers::pi_v<long double>)), p0 = 0;
      p1 *= std::sqrt(2.0L);
      for (int k = 1; k <= m; ++k) p1 *= s * std::sqrt((2.0L * k + 1) / (2.0L * k));
      double largest = 0, error = 0;
      for (int l = m; l <= L; ++l) {
        ASSERT_TRUE(std::isfinite(row[l - m]));
        largest = std::max(largest, std::abs(row[l - m]));
        error = std::max(error, static_cast<double>(std::abs(row[l - m] - p1)));
        const long double ll = l, mm = m, next = (ll + 1) * (ll + 1) - mm * mm;
        const long double back = (2 * ll + 3) * (ll * ll - mm * mm) / ((2 * ll - 1) * next);
        const long double p2 = std::sqrt((2 * ll + 1) * (2 * ll + 3) / next) * x * p1 -
                               (l == m ? 0 : std::sqrt(back) * p0);
        p0 = p1;
        p1 = p2;
      }
      EXPECT_LT(error, 1e-12 * std::max(largest, 0.1)) << m << " " << theta;
    }
  }
}

TEST(ring_sums, are_finite_for_any_colatitude_and_order) {
  std::vector<double> theta;
  for (double t = 1e-320; t < 1.5; t *= 37) theta.push_back(t);
  theta.push_back(kPi / 2);
  const HalfRings rings(theta);
  for (const int m : {0, 1, 5, 300, 5000, 16000, 16384}) {
    const RingOrder order = order_of(m, 16384);
    const Pair sums = adjoint(order, rings, Rows(rings, 7));
    for (const double value : sums.c) ASSERT_TRUE(std::isfinite(value));
    const Rows rows = forward(order, rings, sums);
    for (const auto& part : rows.values) {
      for (const double value : part) ASSERT_TRUE(std::isfinite(value));
    }
  }
}

TEST(ring_sums, forward_and_adjoint_are_transposes) {
  for (const int degree : {5, 100, 301, 700}) {
    const HalfRings rings(some_colatitudes(degree));
    for (const int m : {0, 1, 60, 299, 700}) {
      if (m > degree) continue;
      const RingOrder order = order_of(m, degree);
      const std::size_t n = static_cast<std::size_t>(degree - m) + 1;
      const Pair coefficients{random_values(n, 3), random_values(n, 4)};
      const Rows weights(rings, 5);
      const Rows values = forward(order, rings, coefficients);
      const Pair sums = adjoint(order, rings, weights);
      double there = 0, size = 0;
      for (std::size_t part = 0; part < 4; ++part) {
        there += inner(values.values[part], weights.values[part]);
        size += inner(values.values[part], values.values[part]);
      }
      const double back = inner(sums.c, coefficients.c) + inner(sums.s, coefficients.s);
      // The bound is the rounding of n terms of random sign.
      EXPECT_NEAR(there, back, 1e-14 * std::sqrt(size * static_cast<double>(n))) << m;
    }
  }
}

TEST(ring_sums, rings_may_come_in_any_order) {
  const int degree = 400, m = 30;
  std::vector<double> theta = some_colatitudes(degree);
  const RingOrder order = order_of(m, degree);
  const Pair in_order = adjoint(order, HalfRings(theta), Rows(HalfRings(theta), 5));
  Rows rows(HalfRings(theta), 5);
  std::reverse(theta.begin(), theta.end());
  for (auto& part : rows.values) {
    std::reverse(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(theta.size()));
  }
  const Pair reversed = adjoint(order, HalfRings(theta), rows);
  for (std::size_t i = 0; i < in_order.c.size(); ++i) {
    EXPECT_NEAR(in_order.c[i], reversed.c[i], 1e-12);
    EXPECT_NEAR(in_order.s[i], reversed.s[i], 1e-12);
  }
}

// Compares with sums over single values, for 1 ... 33 rings and as many degrees.
TEST(ring_sums, are_the_sums_over_any_number_of_rings_and_degrees) {
  test::for_each_target([](const char* target) {
    for (int n = 1; n <= 33; ++n) {
      std::vector<double> theta;
      theta.reserve(static_cast<std::size_t>(n));
      for (int i = 0; i < n; ++i) theta.push_back((i + 0.5) / n * kPi / 2);
      const HalfRings rings(theta);
      const std::vector<double> mu = legendre_mu(n);
      for (const int m : {0, 1, n}) {
        const LegendreOrder legendre = legendre_order(m, n, mu[static_cast<std::size_t>(m)]);
        const RingOrder order = order_of(m, n);
        const Rows given(rings, 7);
        const Pair sums = adjoint(order, rings, given);
        Pair expected{std::vector<double>(sums.c.size(), 0.0), std::vector<double>(sums.c.size())};
        const Rows found = forward(order, rings, sums);
        for (std::size_t i = 0; i < rings.size; ++i) {
          const std::vector<double> p =
              legendre_row(legendre, std::cos(theta[i]), std::sin(theta[i]));
          double values[4] = {};
          for (std::size_t l = 0; l < p.size(); ++l) {
            const std::size_t odd = 2 * (l % 2);
            expected.c[l] += p[l] * given.values[odd][i];
            expected.s[l] += p[l] * given.values[odd + 1][i];
            values[odd] += p[l] * sums.c[l];
            values[odd + 1] += p[l] * sums.s[l];
          }
          for (std::size_t part = 0; part < 4; ++part) {
            EXPECT_NEAR(found.values[part][i], values[part], 1e-11) << target << n << " " << m;
          }
        }
        for (std::size_t l = 0; l < sums.c.size(); ++l) {
          EXPECT_NEAR(sums.c[l], expected.c[l], 1e-12) << target << " " << n << " " << m;
          EXPECT_NEAR(sums.s[l], expected.s[l], 1e-12) << target << " " << n << " " << m;
        }
      }
    }
  });
}

TEST(ring_sums, agree_for_every_instruction_set) {
  const int degree = 500;
  const HalfRings rings(some_colatitudes(degree));
  std::vector<Pair> results;
  test::for_each_target([&](const char*) {
    Pair all;
    for (const int m : {0, 3, 77, 250, 499}) {
      const RingOrder order = order_of(m, degree);
      Pair sums = adjoint(order, rings, Rows(rings, 11));
      const Rows rows = forward(order, rings, sums);
      for (const auto& part : rows.values) sums.s.insert(sums.s.end(), part.begin(), part.end());
      all.c.insert(all.c.end(), sums.c.begin(), sums.c.end());
      all.s.insert(all.s.end(), sums.s.begin(), sums.s.end());
    }
    results.push_back(all);
  });
  for (const Pair& result : results) {
    for (std::size_t i = 0; i < result.c.size(); ++i) {
      EXPECT_NEAR(result.c[i], results[0].c[i], 1e-11);
    }
    for (std::size_t i = 0; i < result.s.size(); ++i) {
      EXPECT_NEAR(result.s[i], results[0].s[i], 1e-10 * (1 + std::abs(results[0].s[i])));
    }
  }
}

}  // namespace
}  // namespace rholm
