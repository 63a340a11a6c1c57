// Parts of HTML: escaped text from outside, numbers
// in book style, pictures as data. All text is UTF-8.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rholm::html {

// Escapes text for the content of an element and for a quoted attribute. Control
// characters other than line breaks and tabs, and bytes that are not UTF-8, become U+FFFD.
std::string escaped(std::string_view text);

// Encodes bytes by RFC 4648, section 4.
std::string base64(std::span<const char> bytes);

// Returns markup of a number: groups of three digits, a real minus sign, powers of
// ten as 1.2 x 10^-5 in HTML, "not finite" where there are no digits. It has `digits`
// significant digits; zeros at the end are kept, so that numbers of a column line up.
std::string number(double value, int digits = 4);
// Returns markup with a fixed number of decimals, for numbers of any size below 1e15.
std::string decimal(double value, int decimals);
std::string count(std::size_t n);

// Returns a number with its unit, or a dash if there is no value.
std::string length(const std::optional<double>& value, std::string_view unit, int digits = 4);

}  // namespace rholm::html
