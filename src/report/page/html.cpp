#include "report/page/html.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "report/picture/utf8.h"

namespace rholm::html {
namespace {

constexpr const char* kReplacement = "\xEF\xBF\xBD";  // U+FFFD
constexpr const char* kMinus = "\xE2\x88\x92";        // U+2212
constexpr const char* kThinSpace = "\xE2\x80\xAF";    // U+202F, which does not break
constexpr const char* kDash = "\xE2\x80\x93";         // U+2013

bool is_control(std::string_view character) {
  const auto c = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return (c < 0x20 && c != '\n' && c != '\t') || c == 0x7F;
  // U+0080 ... U+009F are C2 80 ... C2 9F.
  return c == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
}

std::string_view entity(char c) {
  switch (c) {
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '&':
      return "&amp;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

// Puts thin spaces between groups of three digits before the point, from five digits on.
std::string grouped(const std::string& digits) {
  const std::size_t whole = std::min(digits.find('.'), digits.size());
  if (whole < 5) return digits;
  std::string result;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && i < whole && (whole - i) % 3 == 0) result += kThinSpace;
    result += digits[i];
  }
  return result;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = std::max<std::size_t>(utf8_length(text.substr(i)), 1);
    const std::string_view character = text.substr(i, length);
    if (utf8_length(text.substr(i)) == 0 || is_control(character)) {
      result += kReplacement;
    } else if (const std::string_view name = entity(text[i]); !name.empty()) {
      result += name;
    } else {
      result += character;
    }
    i += length;
  }
  return result;
}

std::string base64(std::span<const char> bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = three << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      result += k <= n ? kDigits[three >> (18 - 6 * k) & 63] : '=';
    }
  }
  return result;
}

std::string decimal(double value, int decimals) {
  if (!(std::abs(value) < 1e15)) return number(value, 6);
  const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool zero = digits.find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !zero ? kMinus : "") + grouped(digits);
}

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return "not finite";
  if (value == 0) return "0";
  const std::string scientific = fmt::format("{:.{}e}", std::abs(value), digits - 1);
  const std::size_t e = scientific.find('e');
  const int power = std::stoi(scientific.substr(e + 1));
  const std::string sign = value < 0 ? kMinus : "";
  // Chosen: beyond this range a power is easier to read than zeros are to count.
  if (power >= -3 && power < 7) {
    return sign + grouped(fmt::format("{:.{}f}", std::abs(value), std::max(0, digits - 1 - power)));
  }
  const std::string exponent = fmt::format("{}{}", power < 0 ? kMinus : "", std::abs(power));
  return fmt::format("{}{}{}\xC3\x97{}10<sup>{}</sup>", sign, scientific.substr(0, e), kThinSpace,
                     kThinSpace, exponent);
}

std::string count(std::size_t n) { return grouped(std::to_string(n)); }

std::string length(const std::optional<double>& value, std::string_view unit, int digits) {
  if (!value) return kDash;
  std::string text = number(*value, digits);
  if (!unit.empty()) text += "&nbsp;" + escaped(unit);
  return text;
}

}  // namespace rholm::html
