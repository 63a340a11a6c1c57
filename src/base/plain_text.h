// Prepares text that comes from outside for display: names in files, names of files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rholm {

// The first character of a UTF-8 text: its bytes and its code point. `bytes` is empty where the
// text does not begin with a valid character.
struct Utf8Character {
  std::string_view bytes = {};
  char32_t code = 0;
};
Utf8Character first_character(std::string_view text);

// Returns false for control characters, separators of lines or paragraphs, and marks that turn the
// direction of writing: they are not shown as themselves.
bool is_shown(char32_t code);

// Escapes characters that are not shown: "\x1b" for a byte, "\u202e" for a character. Tabs and ends
// of lines stay.
std::string escaped_text(std::string_view text);
// Escapes ends of lines too: "\n". Tabs stay.
std::string escaped_line(std::string_view text);

// Returns one word of a command line, quoted where needed, as a shell reads it back.
std::string shell_text(const std::string& text);
// Quotes a file's name, and adds "./" to a name that looks like an option: "./-x.ply". "-" stays.
std::string shell_word(const std::string& file);

// Returns "ply, obj or xyz" for last = "or".
std::string listed(const std::vector<std::string>& words, const std::string& last);

// Returns text from a file as a message may show it: in quotes, cut to 40 bytes, with ? for bytes
// that are not printable ASCII.
std::string in_quotes(std::string_view text);

}  // namespace rholm
