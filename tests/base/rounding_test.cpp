#include "base/rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "base/compensated_sum.h"
#include "base/random.h"

namespace rholm {
namespace {

// A compensated sum with a mantissa of 64 bits: exact when compared with double precision.
struct ExactSum {
  long double sum = 0, rest = 0, moduli = 0;
  void add(long double x) {
    const long double t = sum + x;
    rest += std::abs(sum) >= std::abs(x) ? (sum - t) + x : (x - t) + sum;
    sum = t;
    moduli += std::abs(x);
  }
};

double error_of(double found, const ExactSum& exact) {
  const long double off = std::abs((found - exact.sum) - exact.rest);
  return static_cast<double>(off / exact.moduli);
}

// Returns a number of random sign; absolute values are spread over `decades` decades.
double number(std::uint64_t stream, std::uint64_t i, double decades) {
  const double sign = random_uniform(stream, 2 * i) < 0.5 ? -1 : 1;
  return sign * std::pow(10.0, decades * (random_uniform(stream, 2 * i + 1) - 0.5));
}

TEST(Rounding, unit_roundoff_is_half_a_unit_in_the_last_place) {
  EXPECT_EQ(1 + kUnitRoundoff, 1);
  EXPECT_GT(1 + 1.0001 * kUnitRoundoff, 1);
}

TEST(Rounding, compensated_sums_of_any_number_of_terms_leave_what_they_may) {
  std::uint64_t stream = 0;
  for (const std::uint64_t n : {1U, 10U, 1000U, 100000U, 1000000U}) {
    for (const double decades : {0.0, 3.0, 30.0}) {
      ++stream;
      CompensatedSum exact_terms, rounded_terms;
      ExactSum of_terms, of_products;
      for (std::uint64_t i = 0; i < n; ++i) {
        const double x = number(stream, i, decades), y = number(stream + 100, i, decades);
        exact_terms.add(x);
        of_terms.add(x);
        rounded_terms.add(x * y * y);  // rounded twice
        const double product = x * y;
        // The rounding errors of both products are added exactly.
        of_products.add(static_cast<long double>(product * y) +
                        std::fma(product, y, -(product * y)) +
                        static_cast<long double>(std::fma(x, y, -product)) * y);
      }
      EXPECT_LE(error_of(exact_terms.value(), of_terms), rounding_of_sum(0)) << n << " " << decades;
      EXPECT_LE(error_of(rounded_terms.value(), of_products), rounding_of_sum(2))
          << n << " " << decades;
    }
  }
}

TEST(Rounding, whole_quanta_add_up_exactly) {
  double sum = 0;
  std::int64_t quanta = 0;
  for (std::uint64_t i = 0; i < 1000000; ++i) {
    const double q = std::round(std::ldexp(random_uniform(7, i) - 0.5, 30));
    quanta += static_cast<std::int64_t>(q);
    sum += std::ldexp(q, -40);
  }
  EXPECT_EQ(sum, std::ldexp(static_cast<double>(quanta), -40));
}

// The bound does not hold for a plain sum, whose rounding error is larger.
TEST(Rounding, plain_sums_leave_more) {
  double plain = 0;
  ExactSum exact;
  for (std::uint64_t i = 0; i < 1000000; ++i) {
    const double x = 0.1 + random_uniform(9, i);
    plain += x;
    exact.add(x);
  }
  EXPECT_GT(error_of(plain, exact), 2 * rounding_of_sum(0));
}

}  // namespace
}  // namespace rholm
