// The table of formats of coefficients. A new format is a source file with its reader and writer,
// declared in codec.h, and a line of the table in coefficients_formats.cpp. Layer: io.
#pragma once

#include <string_view>
#include <vector>

#include "io/coefficients/codec.h"
#include "io/file/format_lists.h"
#include "rholm/formats.h"

namespace rholm {

// A line of the table. All functions are null for the model file, which the layer model reads and
// writes.
struct CoefficientsFormatLine {
  CoefficientsFormatInfo info = {};
  ToldBy told_by = ToldBy::kNothing;
  bool (*looks_like)(std::string_view bytes) = nullptr;  // required unless told_by is kNothing
  // Returns true if bytes that look like the format hold coefficients and nothing else.
  bool (*is_surely)(std::string_view bytes) = nullptr;
  CoefficientsParser* parse = nullptr;
  CoefficientsFormatter* write = nullptr;
};

// Returns the lines in the order in which people see them, with info.file.read and .written set.
const std::vector<CoefficientsFormatLine>& coefficients_format_table();
const CoefficientsFormatLine& line_of(CoefficientsFormat format);

}  // namespace rholm
