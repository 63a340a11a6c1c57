#include "base/plain_text.h"

#include <algorithm>

namespace rholm {
namespace {

bool is_plain_in_shells(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("_-./:,+@%").find(c) != std::string_view::npos;
}

bool stays(char32_t code, std::string_view allowed) {
  return is_shown(code) ||
         (code < 0x80 && allowed.find(static_cast<char>(code)) != std::string_view::npos);
}

// Returns at least `n_digits` digits.
std::string digits_of(unsigned value, unsigned base, std::size_t n_digits) {
  std::string digits;
  for (; value > 0 || digits.size() < n_digits; value /= base) {
    digits.insert(digits.begin(), "0123456789abcdef"[value % base]);
  }
  return digits;
}

// Escapes characters that are not shown, except the control characters in `allowed`.
std::string escaped(std::string_view text, std::string_view allowed) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character character = first_character(text);
    const auto byte = static_cast<unsigned char>(text.front());
    if (!character.bytes.empty() && stays(character.code, allowed)) {
      result += character.bytes;
    } else if (byte == '\n') {
      result += "\\n";
    } else if (character.bytes.empty() || byte < 0x80) {
      result += "\\x" + digits_of(byte, 16, 2);
    } else {
      result += "\\u" + digits_of(static_cast<unsigned>(character.code), 16, 4);
    }
    text.remove_prefix(std::max<std::size_t>(character.bytes.size(), 1));
  }
  return result;
}

}  // namespace

Utf8Character first_character(std::string_view text) {
  if (text.empty()) return {};
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80) return {text.substr(0, 1), lead};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 0;
  if (length == 0 || text.size() < length) return {};
  char32_t code = lead & (0x7FU >> length);
  for (const char c : text.substr(1, length - 1)) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) != 0x80U) return {};
    code = code << 6U | (byte & 0x3FU);
  }
  // Rejects overlong encodings, halves of UTF-16 pairs and codes beyond the last character.
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kLeast[length] || is_surrogate || code > 0x10FFFF) return {};
  return {text.substr(0, length), code};
}

bool is_shown(char32_t code) {
  if (code < 0x20 || (code >= 0x7F && code < 0xA0)) return false;  // C0, delete, C1
  if (code == 0x61C || code == 0x200E || code == 0x200F || code == 0xFEFF) return false;
  return !(code >= 0x2028 && code <= 0x202E) && !(code >= 0x2066 && code <= 0x2069);
}

std::string escaped_text(std::string_view text) { return escaped(text, "\t\n"); }

std::string escaped_line(std::string_view text) { return escaped(text, "\t"); }

std::string shell_text(const std::string& text) {
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain_in_shells)) return text;
  // Characters that are not shown can be typed in ANSI C quotes, which bash, zsh and ksh read.
  const bool is_one_line = escaped_line(text) == text;
  std::string quoted = is_one_line ? "'" : "$'";
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t size = std::max<std::size_t>(first_character(rest).bytes.size(), 1);
    const std::string_view one = rest.substr(0, size);
    rest.remove_prefix(size);
    if (is_one_line) {
      quoted += one == "'" ? "'\\''" : one;
    } else if (one == "'" || one == "\\") {
      quoted.append("\\").append(one);
    } else if (escaped_line(one) == one) {
      quoted += one;
    } else {
      // An escape of three octal digits ends there, whatever character follows.
      for (const char c : one) quoted += "\\" + digits_of(static_cast<unsigned char>(c), 8, 3);
    }
  }
  return quoted + "'";
}

std::string shell_word(const std::string& file) {
  return shell_text(file.starts_with('-') && file != "-" ? "./" + file : file);
}

std::string listed(const std::vector<std::string>& words, const std::string& last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " " + last + " " : ", ";
    text += words[i];
  }
  return text;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string shown = "'";
  for (const char c : text.substr(0, kLongest)) shown += c < 0x20 || c > 0x7e ? '?' : c;
  shown += text.size() > kLongest ? "...'" : "'";
  return shown;
}

}  // namespace rholm
