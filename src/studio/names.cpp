#include "studio/names.h"

#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>

namespace rholm::studio {
namespace {

constexpr std::size_t kMaxName = 200;      // bytes; chosen: longer texts are no names
constexpr std::size_t kMaxFileName = 255;  // bytes; the limit of file systems

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
    const Utf8Character character = first_character(text);
    if (!character.bytes.empty() && is_shown(character.code)) plain += character.bytes;
    text.remove_prefix(std::max<std::size_t>(character.bytes.size(), 1));
  }
  return plain;
}

std::string plain_name(const std::string& name) {
  std::string plain = plain_text(name.substr(name.find_last_of("/\\") + 1));
  // The cut may split a character; plain_text() removes the incomplete one.
  if (plain.size() > kMaxName) plain = plain_text(plain.substr(0, kMaxName));
  return plain.empty() || plain == "." || plain == ".." || plain == "-" ? "shape" : plain;
}

bool is_file_name(const std::string& text) {
  return !text.empty() && text.size() <= kMaxFileName && text != "." && text != ".." &&
         text != "-" && text.find_first_of("/\\") == std::string::npos && plain_text(text) == text;
}

bool is_variable(const std::string& text) {
  const auto may_follow = [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '_');
  };
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::all_of(text.begin(), text.end(), may_follow) && !is_reserved(text);
}

std::string free_variable(const std::string& text) { return is_reserved(text) ? text + "_" : text; }

std::string python_text(const std::string& text) {
  std::string quoted = "\"";
  for (std::string_view rest = text; !rest.empty();) {
    const Utf8Character character = first_character(rest);
    const auto byte = static_cast<unsigned char>(rest[0]);
    if (character.bytes.empty()) {
      quoted += fmt::format("\\x{:02x}", byte);
    } else if (!is_shown(character.code)) {
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(character.code));
    } else {
      if (byte == '"' || byte == '\\') quoted += '\\';
      quoted += character.bytes;
    }
    rest.remove_prefix(std::max<std::size_t>(character.bytes.size(), 1));
  }
  return quoted + '"';
}

}  // namespace rholm::studio
