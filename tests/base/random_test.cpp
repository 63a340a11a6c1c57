#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rholm {
namespace {

// n uniform numbers have the mean 1/2 +- 1/sqrt(12 n), and neighbours have the correlation 0 +-
// 1/(12 sqrt n). The bounds are six standard deviations.
TEST(random_uniform, mean_variance_and_correlation_are_those_of_the_uniform_distribution) {
  constexpr int n = 100000;
  for (const std::uint64_t seed : {0ULL, 1ULL, 2ULL, ~0ULL}) {
    double mean = 0, square = 0, neighbours = 0;
    for (int i = 0; i < n; ++i) {
      const double u = random_uniform(seed, i);
      ASSERT_GE(u, 0);
      ASSERT_LT(u, 1);
      mean += u / n;
      square += (u - 0.5) * (u - 0.5) / n;
      neighbours += (u - 0.5) * (random_uniform(seed, i + 1) - 0.5) / n;
    }
    EXPECT_NEAR(mean, 0.5, 6 / std::sqrt(12.0 * n));
    EXPECT_NEAR(square, 1 / 12.0, 6 / std::sqrt(180.0 * n));
    EXPECT_NEAR(neighbours, 0, 6 / (12 * std::sqrt(1.0 * n)));
  }
}

TEST(random_bits, seeds_give_different_streams) {
  int equal = 0;
  for (int i = 0; i < 1000; ++i) equal += random_bits(1, i) == random_bits(2, i);
  EXPECT_EQ(equal, 0);
}

}  // namespace
}  // namespace rholm
