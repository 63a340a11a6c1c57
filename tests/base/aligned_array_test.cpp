#include "base/aligned_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/poison.h"

namespace rholm {
namespace {

// Numbers of values below and above the size from which huge pages are used.
constexpr std::size_t kSizes[] = {1, 7, 1000, 700'000};

// Only programs of tests fill new arrays with NaN. A read of memory that was never written would
// otherwise stay unnoticed.
TEST(AlignedArray, is_full_of_nan_in_tests_until_it_is_written) {
  for (const std::size_t n : kSizes) {
    AlignedArray<double> doubles(n);
    AlignedArray<float> floats(n);
    AlignedArray<std::uint32_t> integers(n);
    EXPECT_TRUE(
        std::all_of(doubles.begin(), doubles.end(), [](double x) { return std::isnan(x); }));
    EXPECT_TRUE(std::all_of(floats.begin(), floats.end(), [](float x) { return std::isnan(x); }));
    EXPECT_EQ(integers[n - 1], 0xffffffffU);
  }
  std::vector<double> used(9, 1.0);
  poison_scratch(std::span(used).first(8));
  EXPECT_TRUE(std::isnan(used[0]) && std::isnan(used[7]));
  EXPECT_EQ(used[8], 1);
}

TEST(AlignedArray, of_zeros_is_zero) {
  for (const std::size_t n : kSizes) {
    AlignedArray<double> zeros = AlignedArray<double>::zeros(n);
    EXPECT_EQ(std::count(zeros.begin(), zeros.end(), 0.0), static_cast<std::ptrdiff_t>(n));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(zeros.data()) % 64, 0U);
  }
}

}  // namespace
}  // namespace rholm
