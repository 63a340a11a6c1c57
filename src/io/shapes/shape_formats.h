// The table of formats of shapes. A new format is a source file with its reader and writer, and a
// line of the table in shape_formats.cpp. Reader and writer are declared in shape_source.h and
// shape_writers.h. Layer: io.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/file/format_lists.h"
#include "io/shapes/shape_source.h"
#include "io/shapes/shape_writers.h"
#include "rholm/formats.h"

namespace rholm {

// A line of the table.
struct ShapeFormatLine {
  ShapeFormatInfo info = {};
  std::string mark = {};  // first bytes of all or most of its files; may be empty
  ToldBy told_by = ToldBy::kNothing;
  bool (*looks_like)(std::span<const char> bytes) = nullptr;  // required unless told_by is kNothing
  // Asked if neither content nor name of the file identifies a format.
  bool (*may_be)(std::span<const char> bytes) = nullptr;
  ShapeFile (*read)(const ShapeSource& source) = nullptr;  // null: cannot be read
  ShapeFormatter* write = nullptr;                         // null: cannot be written
};

// Returns the lines in the order in which people see them, with info.file.read and .written set.
const std::vector<ShapeFormatLine>& shape_format_table();
const ShapeFormatLine& line_of(ShapeFormat format);

}  // namespace rholm
