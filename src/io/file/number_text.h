// Numbers from and to text: independent of the locale, without copies. Layer: io.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

namespace rholm {

// A position in a text. Readers move `at` and do not count lines: an error counts them once.
struct TextCursor {
  const char* begin = nullptr;
  const char* at = nullptr;
  const char* end = nullptr;

  explicit TextCursor(std::span<const char> text)
      : begin(text.data()), at(text.data()), end(text.data() + text.size()) {}
  bool at_end() const { return at == end; }
};

// Returns the line number of `at`, from 1. Lines end in \n, \r\n or \r.
std::size_t line_number(const TextCursor& text);

// Returns the word that begins here, quoted, or "the end" if there is none.
std::string quoted_word(const TextCursor& text);

// Throws InvalidInput "name: line 7: what". `lines_before` lines of the file precede the text.
[[noreturn]] void fail_at_line(const std::string& name, const TextCursor& text,
                               const std::string& what, std::size_t lines_before = 0);

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
inline bool is_line_end(char c) { return c == '\n' || c == '\r'; }
inline bool is_space(char c) { return is_blank(c) || is_line_end(c); }

inline void skip_blanks(TextCursor& text) {
  while (text.at != text.end && is_blank(*text.at)) ++text.at;
}
inline void skip_spaces(TextCursor& text) {
  while (text.at != text.end && is_space(*text.at)) ++text.at;
}
// Moves to the \n or \r that ends the line (or to the end of the text), but not past it.
inline void skip_to_line_end(TextCursor& text) {
  while (text.at != text.end && !is_line_end(*text.at)) ++text.at;
}

inline bool at_word_end(const TextCursor& text) { return text.at_end() || is_space(*text.at); }

// Returns the characters up to the next space or the end, and moves past them.
inline std::string_view take_word(TextCursor& text) {
  const char* first = text.at;
  while (text.at != text.end && !is_space(*text.at)) ++text.at;
  return {first, static_cast<std::size_t>(text.at - first)};
}

// Reads the number that begins exactly here (no spaces before it; a leading + is allowed) and moves
// past it. Returns false, without moving, if there is none or it does not fit the type. The caller
// checks what follows. Also reads "nan" and "inf". A number too small for a double is zero; a
// number too large is an error. Results are rounded correctly.
bool take_any_number(TextCursor& text, double& value);
inline bool take_number(TextCursor& text, double& value);
template <class Integer>
bool take_integer(TextCursor& text, Integer& value);

// Room for the longest result of format_number, "-2.2250738585072014e-308".
inline constexpr std::size_t kMaxNumberLength = 32;

// Writes the shortest digits that read back as the same number; returns the end.
template <class Number>
char* format_number(char* first, Number value) {
  return std::to_chars(first, first + kMaxNumberLength, value).ptr;
}

// Reads the usual number: at most 19 digits, as an integer m and a power of ten. If m <= 2^53 and
// the power is at most 10^22, both are exact doubles, so that one division or product rounds once
// (Clinger 1990). Three times as fast as std::from_chars, which reads other numbers.
inline bool take_number(TextCursor& text, double& value) {
  constexpr double kPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  constexpr std::uint64_t kMostExact = std::uint64_t{1} << 53;
  const char* at = text.at;
  const char* const end = text.end;
  const bool negative = at != end && *at == '-';
  if (negative) ++at;
  std::uint64_t m = 0;
  const auto take_digits = [&] {
    const char* first = at;
    for (; at != end && static_cast<unsigned char>(*at - '0') < 10; ++at) {
      m = 10 * m + static_cast<std::uint64_t>(*at - '0');
    }
    return at - first;
  };
  std::ptrdiff_t digits = take_digits();
  std::ptrdiff_t power = 0;
  if (at != end && *at == '.') {
    ++at;
    power = -take_digits();
    digits -= power;
  }
  if (digits == 0 || digits > 19 || m > kMostExact) return take_any_number(text, value);
  if (at != end && (*at == 'e' || *at == 'E')) {
    // Reads a sign and at most two digits of the exponent; other exponents are rare.
    ++at;
    const bool down = at != end && *at == '-';
    if (at != end && (*at == '-' || *at == '+')) ++at;
    int exponent = 0;
    const char* first = at;
    for (; at != end && at - first < 3 && static_cast<unsigned char>(*at - '0') < 10; ++at) {
      exponent = 10 * exponent + (*at - '0');
    }
    if (at == first || at - first > 2) return take_any_number(text, value);
    power += down ? -exponent : exponent;
  }
  if (power < -22 || power > 22) return take_any_number(text, value);
  const double exact = static_cast<double>(m);
  const double result = power < 0 ? exact / kPowers[-power] : exact * kPowers[power];
  value = negative ? -result : result;
  text.at = at;
  return true;
}

template <class Integer>
bool take_integer(TextCursor& text, Integer& value) {
  const char* at = text.at;
  std::uint64_t magnitude = 0;
  // Nine digits fit every type that is read (32 bits and more).
  static_assert(sizeof(Integer) >= 4);
  for (; at != text.end && at - text.at < 9 && static_cast<unsigned char>(*at - '0') < 10; ++at) {
    magnitude = 10 * magnitude + static_cast<std::uint64_t>(*at - '0');
  }
  const bool more = at != text.end && static_cast<unsigned char>(*at - '0') < 10;
  if (at != text.at && !more) {
    value = static_cast<Integer>(magnitude);
    text.at = at;
    return true;
  }
  const char* first = text.at;
  if (first != text.end && *first == '+') {
    ++first;
    if (first != text.end && *first == '-') return false;
  }
  const std::from_chars_result result = std::from_chars(first, text.end, value);
  if (result.ec != std::errc()) return false;
  text.at = result.ptr;
  return true;
}

}  // namespace rholm
