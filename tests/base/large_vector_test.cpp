#include "base/large_vector.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rholm {
namespace {

TEST(large_vector, is_zero_and_not_moved_while_it_has_room) {
  // Sizes: empty, a part of a page, at most one huge page, and several parts.
  for (const std::size_t n : {0u, 10u, 500000u, 5000000u}) {
    for (const int threads : {1, 4}) {
      std::vector<double> v;
      resize_large(v, n, 100, {.threads = threads});
      ASSERT_EQ(v.size(), n);
      EXPECT_TRUE(std::all_of(v.begin(), v.end(), [](double x) { return x == 0; }));
      const double* const at = v.data();
      for (int k = 0; k < 100; ++k) v.push_back(k);
      EXPECT_EQ(v.data(), at);
      release(v);
      EXPECT_EQ(v.capacity(), 0U);
    }
  }
  return_free_memory();
}

}  // namespace
}  // namespace rholm
