// Kernels with 1 ... 33 elements, with every instruction set, on memory full of NaN. The elements
// in the last, partial vectors are compared with plain sums.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "base/aligned_array.h"
#include "harmonic/fft/fft.h"
#include "harmonic/legendre/legendre_degrees.h"
#include "harmonic/legendre/legendre_kernels.h"
#include "harmonic/legendre/legendre_pairs.h"
#include "harmonic/nonuniform/circle_kernels.h"
#include "rholm/harmonic.h"
#include "support/random_data.h"
#include "support/targets.h"

namespace rholm {
namespace {

using test::random_values;

constexpr std::size_t kMost = 33;

template <typename T>
AlignedArray<T> array_of(const std::vector<double>& values, std::size_t room) {
  AlignedArray<T> array(room);
  for (std::size_t i = 0; i < values.size(); ++i) array[i] = static_cast<T>(values[i]);
  return array;
}

template <typename T>
void expect_plain_transforms(const char* target) {
  for (std::size_t half = 1; half <= kMost; ++half) {
    const std::size_t n = 2 * half;
    const double eps = 8 * static_cast<double>(n) * std::numeric_limits<T>::epsilon();
    const std::vector<double> x = random_values(n, half);
    AlignedArray<T> row = array_of<T>(x, n + 2), work(n + 2);
    const RealFft<T> fft(n);
    fft.forward(row.data(), half + 1, work.data());
    const auto wave = [&](std::size_t j, std::size_t k) {
      return std::polar(
          1.0, -2 * std::numbers::pi * static_cast<double>(j * k % n) / static_cast<double>(n));
    };
    for (std::size_t k = 0; k <= half; ++k) {
      std::complex<double> sum = 0;
      for (std::size_t j = 0; j < n; ++j) sum += x[j] * wave(j, k);
      EXPECT_NEAR(row[2 * k], sum.real(), eps) << target << " " << n << " " << k;
      EXPECT_NEAR(row[2 * k + 1], sum.imag(), eps) << target << " " << n << " " << k;
    }
    const std::vector<double> z = random_values(n, half + 100);
    AlignedArray<T> back = array_of<T>(z, n + 2), more(n + 2);
    back[1] = 0;
    fft.backward(back.data(), half, more.data());
    for (std::size_t j = 0; j < n; ++j) {
      double sum = z[0];
      for (std::size_t k = 1; k < half; ++k) {
        sum += 2 * (std::complex(z[2 * k], z[2 * k + 1]) * std::conj(wave(j, k))).real();
      }
      EXPECT_NEAR(back[j], sum, eps) << target << " " << n << " " << j;
    }
  }
}

TEST(KernelSizes, real_transforms_are_the_sums_of_their_definition) {
  test::for_each_target([](const char* target) {
    expect_plain_transforms<float>(target);
    expect_plain_transforms<double>(target);
  });
}

template <typename T>
void expect_plain_products(const char* target) {
  for (std::size_t n = 1; n <= kMost; ++n) {
    const std::vector<double> a = random_values(2 * n, 1), b = random_values(2 * n, 2);
    Factors<T> factors(n);
    for (std::size_t k = 0; k < n; ++k) factors.set(k, a[2 * k], a[2 * k + 1]);
    const AlignedArray<T> in = array_of<T>(b, 2 * n);
    AlignedArray<T> out(2 * n);
    multiply(factors, in.data(), out.data());
    for (std::size_t k = 0; k < n; ++k) {
      const auto product =
          std::complex(a[2 * k], a[2 * k + 1]) * std::complex(b[2 * k], b[2 * k + 1]);
      const double eps = 4 * std::numeric_limits<T>::epsilon();
      EXPECT_NEAR(out[2 * k], product.real(), eps) << target << " " << n;
      EXPECT_NEAR(out[2 * k + 1], product.imag(), eps) << target << " " << n;
    }
  }
}

TEST(KernelSizes, products_of_complex_numbers_are_what_they_are) {
  test::for_each_target([](const char* target) {
    expect_plain_products<float>(target);
    expect_plain_products<double>(target);
  });
}

struct Parts {
  explicit Parts(std::size_t rings) : rows(8 * rings), n(rings) {}
  RingParts of(std::size_t odd) {
    double* const at = rows.data() + 4 * odd * n;
    return {at, at + n, at + 2 * n, at + 3 * n};
  }
  AlignedArray<double> rows;
  std::size_t n;
};

// The fast transforms use multiples of 16 for n, at least (sphere_fourier.h).
template <typename T>
void expect_plain_circles(const char* target) {
  for (std::size_t n = 16; n <= 2 * kMost; n += 2) {
    const double eps = 8 * std::numeric_limits<T>::epsilon();
    const std::vector<double> x = random_values(4 * n, n);
    const AlignedArray<T> circle = array_of<T>(x, 4 * n);
    Parts parts(n / 2);
    split_circle(circle.data(), n, parts.of(0), parts.of(1));
    for (std::size_t q = 0; q < n / 2; ++q) {
      for (std::size_t part = 0; part < 2; ++part) {  // real and imaginary part
        const auto at = [&](std::size_t i) { return x[2 * i + part]; };
        for (std::size_t odd = 0; odd < 2; ++odd) {
          const double sign = odd == 0 ? 1 : -1;
          const double north = at(q) + sign * at(2 * n - 1 - q);
          const double south = at(n - 1 - q) + sign * at(n + q);
          const RingParts p = parts.of(odd);
          EXPECT_NEAR((part == 0 ? p.even_re : p.even_im)[q], north + south, eps) << target << n;
          EXPECT_NEAR((part == 0 ? p.odd_re : p.odd_im)[q], north - south, eps) << target << n;
        }
      }
    }
    // <split(circle), parts> = <circle, join(parts)>
    Parts other(n / 2);
    const std::vector<double> y = random_values(4 * n, n + 1);
    std::copy(y.begin(), y.end(), other.rows.data());
    AlignedArray<T> joined(4 * n);
    join_circle(other.of(0), other.of(1), n, joined.data());
    double left = 0, right = 0;
    for (std::size_t i = 0; i < 4 * n; ++i) {
      left += parts.rows[i] * y[i];
      right += x[i] * static_cast<double>(joined[i]);
    }
    EXPECT_NEAR(left, right, 16 * static_cast<double>(n) * eps) << target << " " << n;
  }
}

TEST(KernelSizes, circles_are_split_into_rings_and_joined_by_the_transpose) {
  test::for_each_target([](const char* target) {
    expect_plain_circles<float>(target);
    expect_plain_circles<double>(target);
  });
}

// circle_kernels.cpp says where a row and its mirror image lie on the circle.
template <typename T>
void expect_plain_gathering(const char* target) {
  for (const int width : {3, 7, 16}) {
    for (std::size_t n_theta = 32; n_theta <= 2 * kMost; n_theta += 2) {
      const GridLayout layout = grid_layout(width, 32, n_theta);
      const std::vector<double> rows = random_values(layout.cells(), n_theta);
      const AlignedArray<T> given = array_of<T>(rows, layout.cells());
      AlignedArray<T> room(kPairs * 2 * n_theta);
      std::vector<double> expected(kPairs * 2 * n_theta, 0.0);
      T* circles[kPairs];
      for (std::size_t p = 0; p < kPairs; ++p) circles[p] = room.data() + p * 2 * n_theta;
      gather_circles(layout, given.data(), circles);
      AlignedArray<T> scattered(layout.cells());
      scatter_circles(layout, circles, scattered.data());
      const auto w = static_cast<std::size_t>(width);
      const auto visit = [&](const auto& see) {
        for (std::size_t row = 0; row < layout.rows; ++row) {
          for (std::size_t p = 0; p < kPairs; ++p) {
            for (std::size_t i = 0; i < 2; ++i) {
              const std::size_t here = (n_theta - row) % n_theta;
              const std::size_t there = (n_theta + row - w) % n_theta;
              const std::size_t at = row * layout.stride + 4 * p + i;
              see(at, at + 2, p * 2 * n_theta + 2 * here + i, p * 2 * n_theta + 2 * there + i);
            }
          }
        }
      };
      visit([&](std::size_t a, std::size_t b, std::size_t here, std::size_t there) {
        expected[here] += rows[a] + rows[b];
        expected[there] += rows[a] - rows[b];
      });
      const double eps = 8 * std::numeric_limits<T>::epsilon();
      for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_NEAR(room[i], expected[i], eps) << target << " " << width << " " << n_theta;
      }
      visit([&](std::size_t a, std::size_t b, std::size_t here, std::size_t there) {
        ASSERT_NEAR(scattered[a], expected[here] + expected[there], 4 * eps) << target;
        ASSERT_NEAR(scattered[b], expected[here] - expected[there], 4 * eps) << target;
      });
    }
  }
}

TEST(KernelSizes, rows_are_gathered_on_great_circles_and_scattered_by_the_transpose) {
  test::for_each_target([](const char* target) {
    expect_plain_gathering<float>(target);
    expect_plain_gathering<double>(target);
  });
}

// Sources are added one after the other, so that each fills its own block.
TEST(KernelSizes, sums_over_sources_are_those_of_single_ones) {
  const int degree = 9;
  const Coefficients f = test::random_coefficients(degree, 3);
  const SumOptions direct{.engine = Engine::kDirect};
  test::for_each_target([&](const char* target) {
    const std::vector<Vec3> directions = test::random_directions(kMost, 4);
    const std::vector<double> weights = random_values(kMost, 5);
    Coefficients expected(degree);
    for (std::size_t n = 1; n <= kMost; ++n) {
      const std::span<const Vec3> some = std::span(directions).first(n);
      const std::span<const double> w = std::span(weights).first(n);
      add_adjoint({.directions = some.last(1), .weights = w.last(1)}, expected, direct);
      const double alone = evaluate(f, some.last(1), direct)[0];
      EXPECT_NEAR(evaluate(f, some, direct)[n - 1], alone, 1e-14 * degree * degree);
      for (const double precision : {1e-4, 1e-11}) {  // windows in single and double precision
        const SumOptions fast{.engine = Engine::kFast, .precision = precision};
        const double size = std::sqrt(static_cast<double>(n)) * degree * degree;
        EXPECT_NEAR(evaluate(f, some, fast)[n - 1], alone, precision * size) << target << " " << n;
        Coefficients sum(degree), plain(degree);
        add_adjoint({.directions = some, .weights = w}, sum, fast);
        add_adjoint({.directions = some, .weights = w}, plain, direct);
        for (int l = 0; l <= degree; ++l) {
          for (int m = 0; m <= l; ++m) {
            EXPECT_NEAR(plain.c(l, m), expected.c(l, m), 1e-13) << target << " " << n;
            EXPECT_NEAR(sum.c(l, m), expected.c(l, m), precision * size) << target << " " << n;
            EXPECT_NEAR(sum.s(l, m), expected.s(l, m), precision * size) << target << " " << n;
          }
        }
      }
    }
  });
}

// Compares each term, at a pole and on both sides of the equator.
TEST(KernelSizes, sums_by_degree_are_the_terms_of_their_definition) {
  const int degree = 300;
  const std::vector<double> mu = legendre_mu(degree);
  test::for_each_target([&](const char* target) {
    for (const std::size_t n : {kLegendreLanes, 2 * kLegendreLanes}) {
      const std::vector<double> cosine = random_values(n, 1), sine = random_values(n, 2);
      std::vector<double> x = random_values(n, 3), sin_theta;
      x[0] = 1, x[1] = -1, x[2] = 0;
      for (const double z : x) sin_theta.push_back(std::sqrt(1 - z * z));
      for (const int m : {0, 1, 2, 150, 300}) {
        const LegendreOrder order = legendre_order(m, degree, mu[static_cast<std::size_t>(m)]);
        const auto rows = static_cast<std::size_t>(degree - m) + 1;
        const std::vector<double> c = random_values(rows, 4), s = random_values(rows, 5);
        std::vector<double> sums(rows * n, 1.0);
        add_by_degree(order, x.data(), sin_theta.data(), cosine.data(), sine.data(), n, c.data(),
                      s.data(), sums.data());
        for (std::size_t j = 0; j < n; ++j) {
          const std::vector<double> p = legendre_row(order, x[j], sin_theta[j]);
          for (std::size_t l = 0; l < rows; ++l) {
            const double expected = 1 + (c[l] * cosine[j] + s[l] * sine[j]) * p[l];
            ASSERT_NEAR(sums[l * n + j], expected, 1e-14 * (1 + std::abs(p[l])))
                << target << " " << m << " " << j << " " << l;
          }
        }
      }
    }
  });
}

TEST(KernelSizes, moments_of_pairs_are_the_sums_of_their_definition) {
  const int degree = 8;
  const std::vector<double> mu = legendre_mu(degree);
  test::for_each_target([&](const char* target) {
    for (const std::size_t n : {kLegendreLanes, 2 * kLegendreLanes}) {
      std::vector<double> x[2], s[2], re[2], im[2];
      for (std::size_t side = 0; side < 2; ++side) {
        re[side] = random_values(n, 10 + side), im[side] = random_values(n, 20 + side);
        x[side] = random_values(n, 30 + side);
        for (const double cosine : x[side]) s[side].push_back(std::sqrt(1 - cosine * cosine));
      }
      for (const int m : {0, 1, 5, 8}) {
        const LegendreOrder order = legendre_order(m, degree, mu[static_cast<std::size_t>(m)]);
        const auto rows = static_cast<std::size_t>(degree - m) + 1;
        std::vector<double> found[6], expected[6];
        for (int k = 0; k < 6; ++k) found[k] = expected[k] = std::vector<double>(rows, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
          const std::vector<double> a = legendre_row(order, x[0][i], s[0][i]);
          const std::vector<double> b = legendre_row(order, x[1][i], s[1][i]);
          for (std::size_t l = 0; l < rows; ++l) {
            for (std::size_t sine = 0; sine < 2; ++sine) {
              const double u = a[l] * (sine == 0 ? re : im)[0][i];
              const double v = b[l] * (sine == 0 ? re : im)[1][i];
              expected[3 * sine][l] += u + v;
              expected[3 * sine + 1][l] += std::pow(u - v, 2);
              expected[3 * sine + 2][l] += std::pow(u - v, 4);
            }
          }
        }
        const auto side = [&](std::size_t i) {
          return PairSide{x[i].data(), s[i].data(), re[i].data(), im[i].data()};
        };
        legendre_pair_moments(order, side(0), side(1), n,
                              {found[0].data(), found[1].data(), found[2].data()},
                              {found[3].data(), found[4].data(), found[5].data()});
        for (int k = 0; k < 6; ++k) {
          for (std::size_t l = 0; l < rows; ++l) {
            EXPECT_NEAR(found[k][l], expected[k][l], 1e-13 * (1 + std::abs(expected[k][l])))
                << target << m;
          }
        }
      }
    }
  });
}

}  // namespace
}  // namespace rholm
