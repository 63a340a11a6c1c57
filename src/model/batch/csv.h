// Comma-separated values, RFC 4180. Layer: model, private.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rholm {

struct CsvRecord {
  std::size_t line = 0;  // that it begins in, from 1
  std::vector<std::string> fields;
};

// All records; lines may end in \n or \r\n, and empty ones are passed over, as is a mark of the
// order of bytes. An apostrophe that csv_field() has put before a text is taken away. Throws
// InvalidInput with the line for quotes that do not match, what is not UTF-8 or has zeros, a field
// above `most_bytes`, and records of different lengths.
std::vector<CsvRecord> parse_csv(std::span<const char> text, const std::string& name,
                                 std::size_t most_bytes);

// A field as it is written: in quotes where it has a comma, a quote or the end of a line. Unless
// `raw`, texts that programs for tables take for formulas (they begin with = + - @, a tab or a
// carriage return, and are no numbers) have an apostrophe before them; so have texts that would
// else be read as those.
std::string csv_field(std::string_view text, bool raw = false);

bool is_utf8(std::string_view text);

}  // namespace rholm
