#include "io/coefficients/expansion_check.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>

#include "base/cancel.h"
#include "base/plain_text.h"
#include "io/file/number_text.h"
#include "rholm/coefficients_io.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Largest size in bytes of a unit or a method's name; chosen long enough for any, short enough for
// one line.
constexpr std::size_t kMaxTextLength = 256;

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw Error(ErrorCode::kInvalidInput, name + ": " + what);
}

// Returns the length of the UTF-8 sequence that starts at text[0], or 0 if it is invalid. RFC 3629
// allows no overlong forms, no surrogates and nothing above U+10FFFF.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const bool overlong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
  const bool surrogate = first == 0xed && byte(1) > 0x9f;
  const bool too_large = first == 0xf4 && byte(1) > 0x8f;
  return overlong || surrogate || too_large ? 0 : length;
}

void check_text(const std::string& text, const char* what, const std::string& name) {
  if (text.size() > kMaxTextLength) {
    refuse(name,
           fmt::format("{} has {} bytes: shorten it to {}", what, text.size(), kMaxTextLength));
  }
  if (!text.empty() && (text.front() == ' ' || text.back() == ' ')) {
    refuse(name, fmt::format("{} begins or ends with a blank: remove it", what));
  }
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = utf8_length(std::string_view(text).substr(i));
    if (length == 0 || byte < 0x20 || byte == 0x7f) {
      refuse(name, fmt::format("{} has byte {:#04x} at {}: it must be one line of UTF-8 text", what,
                               byte, i));
    }
    i += length;
  }
}

void check_norm(const std::optional<double>& value, const char* what, const std::string& name) {
  if (value && !(std::isfinite(*value) && *value >= 0)) {
    refuse(name, fmt::format("{} is {}: it must be finite and not negative", what, *value));
  }
}

}  // namespace

void check_unit(const std::string& unit) {
  check_text(unit, "the name of a unit", in_quotes(unit));
}

void check_coefficients(const Coefficients& coefficients, const std::string& name) {
  const int degree = coefficients.degree();
  CancelPoll poll;
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= degree; ++m) {
      poll();
      const double c = coefficients.c(l, m), s = coefficients.s(l, m);
      if (!std::isfinite(c) || !std::isfinite(s)) {
        refuse(name, fmt::format("coefficient l = {}, m = {} is not finite ({}, {})", l, m, c, s));
      }
      if ((m > l && c != 0) || ((m > l || m == 0) && s != 0)) {
        refuse(name, fmt::format("coefficient l = {}, m = {} is ({}, {}): entries with m > l and "
                                 "sine entries with m = 0 must be zero",
                                 l, m, c, s));
      }
    }
  }
}

void check_expansion(const Expansion& expansion, const std::string& name) {
  check_coefficients(expansion.coefficients, name);
  const Vec3& center = expansion.center;
  if (!is_finite(center)) {
    refuse(name, fmt::format("center ({}, {}, {}) is not finite", center.x, center.y, center.z));
  }
  check_text(expansion.unit, "unit", name);
  check_text(expansion.method, "method", name);
  check_norm(expansion.norm_squared, "norm_squared", name);
  check_norm(expansion.tail_strength, "tail_strength", name);
  check_gravity(expansion, name);
  check_norm(expansion.precision, "precision", name);
}

}  // namespace rholm
