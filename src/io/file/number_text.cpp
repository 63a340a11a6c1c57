#include "io/file/number_text.h"

#include <algorithm>

#include "base/plain_text.h"
#include "rholm/error.h"

namespace rholm {

std::size_t line_number(const TextCursor& text) {
  std::size_t line = 1;
  for (const char* c = text.begin; c != text.at; ++c) {
    const bool ends = *c == '\n' || (*c == '\r' && (c + 1 == text.end || c[1] != '\n'));
    if (ends) ++line;
  }
  return line;
}

std::string quoted_word(const TextCursor& text) {
  TextCursor rest = text;
  const std::string_view word = take_word(rest);
  return word.empty() ? "the end" : in_quotes(word);
}

void fail_at_line(const std::string& name, const TextCursor& text, const std::string& what,
                  std::size_t lines_before) {
  throw Error(ErrorCode::kInvalidInput,
              name + ": line " + std::to_string(lines_before + line_number(text)) + ": " + what);
}

namespace {

// std::from_chars gives no value for 1e-400 or 1e400: returns true if [first, last) is tiny.
bool is_tiny(const char* first, const char* last) {
  const char* exponent = std::find_if(first, last, [](char c) { return c == 'e' || c == 'E'; });
  if (exponent != last) return exponent[1] == '-';
  // Without an exponent, 0.000...1 is tiny; a nonzero digit before the point makes it huge.
  const char* significant = std::find_if(first, last, [](char c) { return c >= '1' && c <= '9'; });
  return significant > std::find(first, last, '.');
}

}  // namespace

bool take_any_number(TextCursor& text, double& value) {
  const char* first = text.at;
  if (first != text.end && *first == '+') {
    ++first;
    if (first != text.end && *first == '-') return false;
  }
  const std::from_chars_result result = std::from_chars(first, text.end, value);
  if (result.ec == std::errc::result_out_of_range) {
    if (!is_tiny(first, result.ptr)) return false;
    value = *first == '-' ? -0.0 : 0.0;
  } else if (result.ec != std::errc()) {
    return false;
  }
  text.at = result.ptr;
  return true;
}

}  // namespace rholm
