#include "io/file/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "base/random.h"
#include "io/shapes/test_support.h"

namespace rholm {
namespace {

// Returns the number at the beginning of the text; `rest` is the expected text after it.
std::optional<double> number_of(std::string_view text, std::string_view rest = "") {
  TextCursor cursor({text.data(), text.size()});
  double value = 0;
  if (!take_number(cursor, value)) {
    EXPECT_EQ(cursor.at, text.data()) << text;
    return std::nullopt;
  }
  EXPECT_EQ(std::string_view(cursor.at, static_cast<std::size_t>(cursor.end - cursor.at)), rest);
  return value;
}

TEST(take_number, reads_every_usual_notation) {
  EXPECT_EQ(number_of("0"), 0.0);
  EXPECT_EQ(number_of("-12"), -12.0);
  EXPECT_EQ(number_of("+12"), 12.0);
  EXPECT_EQ(number_of(".5"), 0.5);
  EXPECT_EQ(number_of("5."), 5.0);
  EXPECT_EQ(number_of("1.5e+03"), 1500.0);
  EXPECT_EQ(number_of("1.5E-3"), 0.0015);
  EXPECT_EQ(number_of("0.1"), 0.1);
  EXPECT_EQ(number_of("1.7976931348623157e308"), std::numeric_limits<double>::max());
  EXPECT_EQ(number_of("4.9406564584124654e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(number_of("12 13", " 13"), 12.0);
  EXPECT_EQ(number_of("12,13", ",13"), 12.0);
  EXPECT_EQ(number_of("1e5x", "x"), 1e5);
  EXPECT_EQ(number_of("inf"), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(*number_of("nan")));
}

TEST(take_number, refuses_what_is_no_number) {
  for (const char* text : {"", "-", "+", "+-1", "-+1", "--1", ".", "e5", "x", " 1", ",1", "++1"}) {
    EXPECT_EQ(number_of(text), std::nullopt) << text;
  }
}

TEST(take_number, too_small_is_zero_and_too_large_is_no_number) {
  EXPECT_EQ(number_of("1e-400"), 0.0);
  EXPECT_TRUE(std::signbit(*number_of("-1e-400")));
  std::string digits = "0.";
  digits.append(400, '0').append("1");
  EXPECT_EQ(number_of(digits), 0.0);
  std::string whole = "1";
  whole.append(400, '0');
  EXPECT_EQ(number_of("1e-99999999999999999999 2", " 2"), 0.0);
  EXPECT_EQ(number_of("1e400"), std::nullopt);
  EXPECT_EQ(number_of("-1e400"), std::nullopt);
  EXPECT_EQ(number_of(whole), std::nullopt);
  EXPECT_EQ(number_of(whole + "e-400"), 1.0);
}

// The oracle is the C library, whose rounding is correct.
TEST(take_number, agrees_with_strtod_on_random_digits) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const int digits = 1 + static_cast<int>(random_bits(1, i) % 20);
    std::string text = random_bits(2, i) % 2 == 0 ? "-" : "";
    for (int k = 0; k < digits; ++k) {
      if (k == static_cast<int>(random_bits(3, i) % 20)) text += '.';
      text += static_cast<char>('0' + random_bits(4, 32 * i + static_cast<unsigned>(k)) % 10);
    }
    if (random_bits(5, i) % 3 == 0) {
      text += 'e';
      text += std::to_string(static_cast<int>(random_bits(6, i) % 560) - 280);
    }
    ASSERT_EQ(number_of(text), std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(take_integer, refuses_overflow_and_signs_that_do_not_belong) {
  const auto read = [](std::string_view text) {
    TextCursor cursor({text.data(), text.size()});
    std::int64_t value = 0;
    return take_integer(cursor, value) ? std::optional(value) : std::nullopt;
  };
  EXPECT_EQ(read("12"), 12);
  EXPECT_EQ(read("+12"), 12);
  EXPECT_EQ(read("-12"), -12);
  EXPECT_EQ(read("0012"), 12);
  EXPECT_EQ(read("9223372036854775807"), INT64_MAX);
  EXPECT_EQ(read("-9223372036854775808"), INT64_MIN);
  for (const char* text : {"9223372036854775808", "-9223372036854775809", "", "-", "+-1", "x"}) {
    EXPECT_EQ(read(text), std::nullopt) << text;
  }
}

TEST(format_number, gives_the_shortest_digits_that_read_back) {
  const auto text_of = [](auto value) {
    char digits[kMaxNumberLength];
    return std::string(digits, format_number(digits, value));
  };
  EXPECT_EQ(text_of(0.1), "0.1");
  EXPECT_EQ(text_of(1.0), "1");
  EXPECT_EQ(text_of(-0.0), "-0");
  EXPECT_EQ(text_of(0.1f), "0.1");
  EXPECT_EQ(text_of(std::uint64_t{12}), "12");
  EXPECT_EQ(text_of(-2.2250738585072014e-308), "-2.2250738585072014e-308");
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const auto value = std::bit_cast<double>(random_bits(7, i));
    if (!std::isfinite(value)) continue;
    ASSERT_EQ(number_of(text_of(value)), value);
  }
}

TEST(line_number, counts_lines_of_every_kind) {
  const auto line_of = [](std::string_view text, std::size_t place) {
    TextCursor cursor({text.data(), text.size()});
    cursor.at += place;
    return line_number(cursor);
  };
  EXPECT_EQ(line_of("", 0), 1u);
  EXPECT_EQ(line_of("a\nb\nc", 4), 3u);
  EXPECT_EQ(line_of("a\r\nb\r\nc", 6), 3u);
  EXPECT_EQ(line_of("a\rb\rc", 4), 3u);
  EXPECT_EQ(line_of("a\n\n\nb", 4), 4u);
}

}  // namespace
}  // namespace rholm
