#include "base/indices_where.h"

#include <gtest/gtest.h>

namespace rholm {
namespace {

TEST(indices_where, are_ascending_whatever_the_number_of_threads) {
  for (const std::size_t n : {0u, 1u, 8191u, 8192u, 100000u}) {
    for (const int threads : {1, 4}) {
      const std::vector<std::uint32_t> found =
          indices_where(n, {.threads = threads}, [](std::uint32_t i) { return i % 3 == 1; });
      ASSERT_EQ(found.size(), (n + 1) / 3);
      for (std::size_t k = 0; k < found.size(); ++k) ASSERT_EQ(found[k], 3 * k + 1);
    }
  }
}

}  // namespace
}  // namespace rholm
