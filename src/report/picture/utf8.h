// Finds the end of a UTF-8 character.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace rholm {

// Returns the bytes of the character at the front of `text` (not empty); 0 if there is none.
// Overlong forms of three and four bytes pass, because the encoded value is not checked.
inline std::size_t utf8_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return 1;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  const std::string_view rest = text.substr(1, length - 1);
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  return rest.size() == length - 1 && std::all_of(rest.begin(), rest.end(), continues) ? length : 0;
}

}  // namespace rholm
