// Pieces of HTML: text from outside made harmless, numbers as they are printed in books, pictures
// as data. All text is UTF-8.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rholm::html {

// For the content of an element and for an attribute in quotes. Control characters other than line
// breaks and tabs, and bytes that are not UTF-8, become U+FFFD.
std::string escaped(std::string_view text);

// RFC 4648, section 4.
std::string base64(std::span<const char> bytes);

// As markup: groups of three digits, a real minus sign, powers of ten as 1.2 x 10^-5 with what
// HTML has for it; "not finite" for what has no digits. `digits` significant ones, zeros at the end
// kept, so that numbers of a column line up.
std::string number(double value, int digits = 4);
// The same with a fixed number of decimals, for numbers of any size below 1e15.
std::string decimal(double value, int decimals);
std::string count(std::size_t n);

// A number with a unit after it; a dash for none.
std::string length(const std::optional<double>& value, std::string_view unit, int digits = 4);

}  // namespace rholm::html
