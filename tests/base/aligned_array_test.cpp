#include "base/aligned_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/poison.h"

namespace rholm {
namespace {

// Below and beyond what is placed on huge pages.
constexpr std::size_t kSizes[] = {1, 7, 1000, 700'000};

// The programs of the tests differ from the library in this: else nothing would find a read of
// memory that nobody has written.
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
