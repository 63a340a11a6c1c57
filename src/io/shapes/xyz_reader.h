// Lines of numbers in two steps, for what reads a file in pieces. Layer: io.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/file/number_text.h"
#include "io/shapes/shape_source.h"
#include "rholm/mesh.h"

namespace rholm {

// What stands before the first row of values.
struct XyzHeader {
  std::vector<std::string> names;  // of the columns, or empty
  bool has_count = false;
  double count = 0;         // of points, as claimed
  std::size_t columns = 0;  // values in the first row; 0 if there is none
};

// Moves `text` to the first row of values (or the end).
XyzHeader take_xyz_header(TextCursor& text);
// Throws InvalidInput for one that no points can follow; it ends, and the row stands, `at` bytes
// from the begin.
void check_xyz_header(const ShapeSource& source, const XyzHeader& header, std::size_t at);

// Whole lines behind a header. `names`: of the columns, which then are the same in each piece.
PointCloud read_xyz_piece(const ShapeSource& source, const std::vector<std::string>& names,
                          std::size_t columns, bool pwn);

// Whether columns without names behind the position are normals, by the name of the file.
bool is_pwn(const std::string& name);

}  // namespace rholm
