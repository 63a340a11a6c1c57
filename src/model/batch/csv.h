// Comma-separated values, RFC 4180. Layer: model, private.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rholm {

struct CsvRecord {
  std::size_t line = 0;  // line of its start, from 1
  std::vector<std::string> fields;
};

// Returns all records. Lines may end in \n or \r\n; empty lines and a byte order mark are skipped.
// An apostrophe from csv_field() before a text is removed. Throws InvalidInput with the line for
// unbalanced quotes, invalid UTF-8 or zeros, a field above `most_bytes`, and records of different
// lengths.
std::vector<CsvRecord> parse_csv(std::span<const char> text, const std::string& name,
                                 std::size_t most_bytes);

// Returns a field for a file, in quotes if it has a comma, a quote or a line end. Unless `raw`, an
// apostrophe precedes texts that spreadsheet programs take for formulas: they begin with = + - @, a
// tab or a carriage return, and are no numbers. Texts of this form that already begin with
// apostrophes get one more.
std::string csv_field(std::string_view text, bool raw = false);

bool is_utf8(std::string_view text);

}  // namespace rholm
