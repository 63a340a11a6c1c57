// Text that comes from outside, as it may be shown: names in files, names of files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rholm {

// The character of UTF-8 at the begin of `text`: its bytes and its code point; no bytes where there
// is none.
struct Utf8Character {
  std::string_view bytes = {};
  char32_t code = 0;
};
Utf8Character first_character(std::string_view text);

// Whether a character is shown as itself: no control character, no separator of lines or
// paragraphs, no mark that turns the direction of writing.
bool is_shown(char32_t code);

// Escapes what is not shown: "\x1b" for a byte, "\u202e" for a character. Tabs and ends of lines
// stay.
std::string escaped_text(std::string_view text);
// Ends of lines are escaped too: "\n".
std::string escaped_line(std::string_view text);

// One word of a command line as a shell reads it back.
std::string shell_text(const std::string& text);
// The same for the name of a file, which is never taken for an option: "./-x.ply". "-" stays.
std::string shell_word(const std::string& file);

// "ply, obj or xyz" with last = "or".
std::string listed(const std::vector<std::string>& words, const std::string& last);

// Text from a file as a message may show it: in quotes, cut to 40 bytes, ? for what is not
// printable ASCII.
std::string in_quotes(std::string_view text);

}  // namespace rholm
