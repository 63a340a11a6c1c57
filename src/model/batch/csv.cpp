#include "model/batch/csv.h"

#include <fmt/format.h>

#include "io/file/number_text.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Returns true if a text begins like a formula, also after apostrophes.
bool begins_like_formula(std::string_view text) {
  const std::size_t first = text.find_first_not_of('\'');
  constexpr std::string_view kBeginnings = "=+-@\t\r";
  return first != std::string_view::npos && kBeginnings.find(text[first]) != std::string_view::npos;
}

bool is_number(std::string_view text) {
  TextCursor cursor(text);
  double value = 0;
  return take_number(cursor, value) && cursor.at_end();
}

// Parses the text in one pass. A quote opens a field only at its start; within the field, two
// quotes stand for one.
class CsvReader {
 public:
  CsvReader(std::span<const char> text, const std::string& name, std::size_t most_bytes)
      : text_(text), name_(name), most_bytes_(most_bytes) {
    if (std::string_view(text.data(), text.size()).starts_with("\xef\xbb\xbf")) text_.at += 3;
  }

  std::vector<CsvRecord> records() {
    std::vector<CsvRecord> records;
    while (!text_.at_end()) {
      if (end_of_line()) continue;
      CsvRecord record{.line = line_, .fields = {}};
      do {
        record.fields.push_back(field());
      } while (comma());
      if (!text_.at_end() && !end_of_line()) {
        fail("behind the quote that closes a field comes a comma or the end of the line");
      }
      if (!records.empty() && record.fields.size() != records.front().fields.size()) {
        throw Error(ErrorCode::kInvalidInput,
                    fmt::format("{}: line {}: has {} fields, and the first line has {}", name_,
                                record.line, record.fields.size(), records.front().fields.size()));
      }
      records.push_back(std::move(record));
    }
    return records;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::kInvalidInput, fmt::format("{}: line {}: {}", name_, line_, what));
  }

  bool comma() {
    if (text_.at_end() || *text_.at != ',') return false;
    ++text_.at;
    return true;
  }

  bool end_of_line() {
    const std::string_view rest(text_.at, static_cast<std::size_t>(text_.end - text_.at));
    if (!rest.starts_with('\n') && !rest.starts_with("\r\n")) return false;
    text_.at += rest.front() == '\r' ? 2 : 1;
    ++line_;
    return true;
  }

  std::string field() {
    std::string value = !text_.at_end() && *text_.at == '"' ? quoted() : plain();
    if (value.starts_with('\'') && begins_like_formula(value)) value.erase(0, 1);
    if (!is_utf8(value) || value.find('\0') != std::string::npos) fail("is not text in UTF-8");
    return value;
  }

  void take(std::string& value) {
    if (value.size() == most_bytes_) {
      fail(fmt::format("a field has more than {} bytes", most_bytes_));
    }
    value += *text_.at++;
  }

  std::string plain() {
    std::string value;
    while (!text_.at_end() && *text_.at != ',' && *text_.at != '\n') {
      const bool before_end = text_.at + 1 != text_.end && text_.at[1] == '\n';
      if (*text_.at == '\r' && before_end) break;
      if (*text_.at == '"')
        fail("a quote within a field: write the field in quotes, each quote twice");
      take(value);
    }
    return value;
  }

  std::string quoted() {
    std::string value;
    const std::size_t first_line = line_;
    for (++text_.at; !text_.at_end();) {
      if (*text_.at == '"') {
        ++text_.at;
        if (text_.at_end() || *text_.at != '"') return value;
      } else if (*text_.at == '\n') {
        ++line_;
      }
      take(value);
    }
    line_ = first_line;
    fail("the quote that opens a field is never closed");
  }

  TextCursor text_;
  const std::string& name_;
  std::size_t most_bytes_;
  std::size_t line_ = 1;
};

}  // namespace

std::vector<CsvRecord> parse_csv(std::span<const char> text, const std::string& name,
                                 std::size_t most_bytes) {
  return CsvReader(text, name, most_bytes).records();
}

std::string csv_field(std::string_view text, bool raw) {
  if (!raw && begins_like_formula(text) && !is_number(text)) {
    return csv_field("'" + std::string(text), true);
  }
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + '"';
}

// Unicode 15, table 3-7: no surrogates, nothing above U+10FFFF, no more bytes than needed.
bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U;
    };
    const unsigned first = byte(0);
    const std::size_t length = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (length > 1 && (first < 0xc2 || first > 0xf4)) return false;
    const unsigned least = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    const unsigned most = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    if (length > 1 && (byte(1) < least || byte(1) > most)) return false;
    for (std::size_t k = 2; k < length; ++k) {
      if (byte(k) < 0x80 || byte(k) > 0xbf) return false;
    }
    i += length;
  }
  return true;
}

}  // namespace rholm
