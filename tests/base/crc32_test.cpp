#include "base/crc32.h"

#include <gtest/gtest.h>

#include <string>

#include "base/random.h"

namespace rholm {
namespace {

// Returns the checksum bit by bit, as the remainder of a division of polynomials.
std::uint32_t by_bits(std::string_view bytes) {
  std::uint32_t value = 0xffffffffU;
  for (const char c : bytes) {
    value ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) value = value >> 1 ^ ((value & 1) != 0 ? 0xedb88320U : 0);
  }
  return ~value;
}

TEST(crc32, has_the_check_value_of_its_catalogue) {
  EXPECT_EQ(crc32("123456789"), 0xcbf43926U);
  EXPECT_EQ(crc32(""), 0U);
}

TEST(crc32, is_the_remainder_for_any_length_and_in_any_two_parts) {
  std::string bytes;
  for (std::size_t n = 0; n < 100; ++n) {
    EXPECT_EQ(crc32(bytes), by_bits(bytes));
    for (const std::size_t first : {n / 3, n / 2, n}) {
      const std::string_view all = bytes;
      EXPECT_EQ(crc32(all.substr(first), crc32(all.substr(0, first))), by_bits(bytes));
    }
    bytes += static_cast<char>(random_bits(1, n));
  }
}

}  // namespace
}  // namespace rholm
