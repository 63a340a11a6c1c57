#include "studio/names.h"

#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>

#include "model/batch/csv.h"
#include "report/picture/utf8.h"

namespace rholm::studio {
namespace {

constexpr std::size_t kMaxName = 200;      // bytes; chosen: longer ones are no names
constexpr std::size_t kMaxFileName = 255;  // bytes; what file systems take

// The code point of a character of UTF-8.
char32_t code_of(std::string_view character) {
  const auto lead = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return lead;
  char32_t code = lead & (0x7FU >> character.size());
  for (const char c : character.substr(1)) {
    code = code << 6U | (static_cast<unsigned char>(c) & 0x3FU);
  }
  return code;
}

bool prints(char32_t code) {
  if (code < 0x20 || (code >= 0x7F && code < 0xA0)) return false;  // C0, delete, C1
  if (code == 0x61C || code == 0x200E || code == 0x200F) return false;
  return !(code >= 0x2028 && code <= 0x202E) && !(code >= 0x2066 && code <= 0x2069) &&
         code != 0xFEFF;
}

// The front of `text` that is one character; empty if it is not UTF-8.
std::string_view character_at(std::string_view text) {
  const std::string_view character = text.substr(0, utf8_length(text));
  return is_utf8(character) ? character : std::string_view();  // overlong forms are not
}

bool is_plain(unsigned char c) {
  return std::isalnum(c) != 0 ||
         std::string_view("_-./:,+@%").find(static_cast<char>(c)) != std::string_view::npos;
}

bool is_reserved(const std::string& name) {
  static const std::set<std::string> kReserved = {
      "rholm", "and",    "as",   "assert", "async",  "await",    "break", "class", "continue",
      "def",   "del",    "elif", "else",   "except", "finally",  "for",   "from",  "global",
      "if",    "import", "in",   "is",     "lambda", "nonlocal", "not",   "or",    "pass",
      "raise", "return", "try",  "while",  "with",   "yield",    "False", "None",  "True"};
  return kReserved.contains(name);
}

}  // namespace

std::string plain_text(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const std::string_view character = character_at(text);
    if (!character.empty() && prints(code_of(character))) plain += character;
    text.remove_prefix(std::max<std::size_t>(character.size(), 1));
  }
  return plain;
}

std::string plain_name(const std::string& name) {
  std::string plain = plain_text(name.substr(name.find_last_of("/\\") + 1));
  // Cut between two characters: a torn one goes.
  if (plain.size() > kMaxName) plain = plain_text(plain.substr(0, kMaxName));
  return plain.empty() || plain == "." || plain == ".." ? "shape" : plain;
}

bool is_file_name(const std::string& text) {
  return !text.empty() && text.size() <= kMaxFileName && text != "." && text != ".." &&
         text.find_first_of("/\\") == std::string::npos && plain_text(text) == text;
}

bool is_variable(const std::string& text) {
  const auto may_follow = [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '_');
  };
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::all_of(text.begin(), text.end(), may_follow) && !is_reserved(text);
}

std::string free_variable(const std::string& text) { return is_reserved(text) ? text + "_" : text; }

std::string shell_text(const std::string& text) {
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_word(const std::string& file) {
  return shell_text(file.starts_with('-') ? "./" + file : file);
}

std::string python_text(const std::string& text) {
  std::string quoted = "\"";
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view character = character_at(rest);
    const auto byte = static_cast<unsigned char>(rest[0]);
    if (character.empty()) {
      quoted += fmt::format("\\x{:02x}", byte);
    } else if (const char32_t code = code_of(character); !prints(code)) {
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(code));
    } else {
      if (byte == '"' || byte == '\\') quoted += '\\';
      quoted += character;
    }
    rest.remove_prefix(std::max<std::size_t>(character.size(), 1));
  }
  return quoted + '"';
}

}  // namespace rholm::studio
