// Points as lines of numbers (XYZ, PWN, TXT, CSV), with any columns behind the position.
//
// Values are separated by spaces, tabs, commas or semicolons; #, // and % begin comments. The first
// line may be the number of points (PWN, PTS) or the names of the columns; a comment that names as
// many columns as the first line has values counts as such. Without names, the columns after x y z
// are: a normal, if there are three or more and the first three are unit vectors (or zero) to
// 1 % in every line; else red, green, blue, if there are exactly three and all are integers
// 0 ... 255; else scalar_1, scalar_2, ... In a PWN file the three are always normals, and may
// also follow as lines of their own after all positions.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/file/number_text.h"
#include "io/shapes/shape_source.h"
#include "io/shapes/xyz_columns.h"
#include "io/shapes/xyz_reader.h"

namespace rholm {
namespace {

bool is_separator(char c) { return is_blank(c) || c == ',' || c == ';'; }

void skip_separators(TextCursor& text) {
  while (!text.at_end() && is_separator(*text.at)) ++text.at;
}

bool at_comment(const TextCursor& text) {
  if (text.at_end()) return false;
  if (*text.at == '#' || *text.at == '%') return true;
  return *text.at == '/' && text.at + 1 != text.end && text.at[1] == '/';
}

bool at_row_end(const TextCursor& text) {
  return text.at_end() || is_line_end(*text.at) || at_comment(text);
}

bool at_value_end(const TextCursor& text) { return at_row_end(text) || is_separator(*text.at); }

// The number that begins here and ends where a value may.
bool take_value(TextCursor& text, double& value) {
  const TextCursor before = text;
  if (take_number(text, value) && at_value_end(text)) return true;
  text = before;
  return false;
}

// Names separated like values, without quotes; to the end of the line.
std::vector<std::string> take_names(TextCursor& text) {
  std::vector<std::string> names;
  for (;;) {
    skip_separators(text);
    if (text.at_end() || is_line_end(*text.at)) return names;
    std::string name;
    while (!text.at_end() && !is_line_end(*text.at) && !is_separator(*text.at)) {
      if (*text.at != '"') name += *text.at;
      ++text.at;
    }
    names.push_back(std::move(name));
  }
}

std::size_t values_in_row(TextCursor text) {
  double value = 0;
  for (std::size_t n = 0;; ++n) {
    skip_separators(text);
    if (at_row_end(text)) return n;
    if (!take_value(text, value)) return 0;
  }
}

// The names in a comment line, if they may be those of columns.
std::vector<std::string> names_in_comment(TextCursor text) {
  while (!text.at_end() && (*text.at == '#' || *text.at == '/' || *text.at == '%')) ++text.at;
  std::vector<std::string> names = take_names(text);
  return has_position(names) ? names : std::vector<std::string>();
}

}  // namespace

XyzHeader take_xyz_header(TextCursor& text) {
  XyzHeader header;
  bool names_are_comment = false;
  bool names_were_line = false;
  for (;; skip_to_line_end(text)) {
    skip_spaces(text);
    skip_separators(text);
    if (text.at_end()) return header;
    if (is_line_end(*text.at)) continue;
    if (at_comment(text)) {
      if (std::vector<std::string> names = names_in_comment(text); !names.empty()) {
        header.names = std::move(names);
        names_are_comment = true;
      }
      continue;
    }
    const std::size_t n = values_in_row(text);
    if (n == 1 && !header.has_count) {
      header.has_count = true;
      take_value(text, header.count);
    } else if (n == 0 && !names_were_line) {
      header.names = take_names(text);
      names_are_comment = false;
      names_were_line = true;
    } else {
      header.columns = n;
      if (names_are_comment && header.names.size() != n) header.names.clear();
      return header;
    }
  }
}

namespace {

class XyzReader {
 public:
  XyzReader(const ShapeSource& source, bool pwn, std::size_t at = 0)
      : source_(source), text_(source.bytes), pwn_(pwn) {
    text_.at += at;
  }

  ShapeFile read() {
    const XyzHeader header = take_xyz_header(text_);
    check_header(header);
    const ColumnRoles roles = column_roles(header.names, header.columns);
    read_rows(roles, header.columns);
    return finish(header, roles);
  }

  PointCloud read_piece(const std::vector<std::string>& names, std::size_t columns) {
    const ColumnRoles roles = column_roles(names, columns);
    read_rows(roles, columns);
    return cloud_of(roles);
  }

  void check_header(const XyzHeader& header) const {
    if (!header.names.empty() && header.columns > 0 && !has_position(header.names)) {
      fail_line("the header names no columns x, y, z");
    }
    if (header.columns == 0 && !text_.at_end()) {
      fail_line(quoted_word(text_) + " does not begin a row of numbers");
    }
    if (header.columns == 0) source_.fail("has no points");
    if (header.columns < 3) {
      fail_line("a point needs 3 coordinates, here are " +
                counted(header.columns, "value", "values"));
    }
    if (!header.names.empty() && header.names.size() != header.columns) {
      fail_line("the header names " + std::to_string(header.names.size()) +
                " columns, but this line has " + counted(header.columns, "value", "values"));
    }
  }

 private:
  void read_rows(const ColumnRoles& roles, std::size_t columns) {
    columns_.resize(columns);
    std::vector<double> row(columns);
    for (std::size_t n = 0; next_row(); ++n) {
      read_row(row);
      const Vec3 p = {row[roles.position[0]], row[roles.position[1]], row[roles.position[2]]};
      if (!is_finite(p)) fail_line("a coordinate is not a finite number");
      points_.push_back(p);
      for (const std::size_t k : roles.others) columns_[k].push_back(row[k]);
      if (n % 256 == 0) source_.progress(text_.at);
    }
  }

  // To the first value of the next row; false at the end.
  bool next_row() {
    for (;;) {
      skip_spaces(text_);
      skip_separators(text_);
      if (text_.at_end()) return false;
      if (!at_row_end(text_)) return true;
      skip_to_line_end(text_);
    }
  }

  void read_row(std::vector<double>& row) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      skip_separators(text_);
      if (at_row_end(text_)) {
        fail_line("has " + counted(k, "value", "values") + ", the first line has " +
                  std::to_string(row.size()));
      }
      if (!take_value(text_, row[k])) fail_line(quoted_word(text_) + " is not a number");
    }
    skip_separators(text_);
    if (!at_row_end(text_)) {
      fail_line("has more values than the first line, which has " + std::to_string(row.size()));
    }
    skip_to_line_end(text_);
  }

  ShapeFile finish(const XyzHeader& header, const ColumnRoles& roles) {
    std::vector<Vec3> normals;
    const std::size_t rows = points_.size();
    const bool normals_follow =
        header.has_count && header.columns == 3 && header.count == static_cast<double>(rows) / 2;
    if (normals_follow) {
      const auto middle = points_.begin() + static_cast<std::ptrdiff_t>(rows / 2);
      normals.assign(middle, points_.end());
      points_.resize(rows / 2);
    } else if (header.has_count && header.count != static_cast<double>(rows)) {
      char digits[kMaxNumberLength];
      source_.fail("its first line promises " +
                   std::string(digits, format_number(digits, header.count)) + " points, but " +
                   std::to_string(rows) + " follow");
    }
    PointCloud cloud = cloud_of(roles);
    if (normals_follow) cloud.normals = std::move(normals);
    if (normals_follow) check_finite(source_, cloud.normals, 0, "point", "normal");
    ShapeFile file;
    file.shape = std::move(cloud);
    file.format = ShapeFormat::kXyz;
    file.encoding = "ascii";
    return file;
  }

  PointCloud cloud_of(const ColumnRoles& roles) {
    PointCloud cloud;
    cloud.points = std::move(points_);
    take_columns(cloud, roles, columns_, pwn_);
    check_finite(source_, cloud.normals, source_.rows_before, "point", "normal");
    if (!source_.attributes) cloud.attributes.clear();
    return cloud;
  }

  [[noreturn]] void fail_line(const std::string& what) const {
    fail_at_line(source_.name, text_, what, source_.lines_before);
  }

  const ShapeSource& source_;
  TextCursor text_;
  bool pwn_;
  std::vector<Vec3> points_;
  std::vector<std::vector<double>> columns_;  // those of position stay empty
};

}  // namespace

bool is_pwn(const std::string& name) { return name.ends_with(".pwn") || name.ends_with(".PWN"); }

ShapeFile read_xyz(const ShapeSource& source) {
  return XyzReader(source, is_pwn(source.name)).read();
}

void check_xyz_header(const ShapeSource& source, const XyzHeader& header, std::size_t at) {
  XyzReader(source, false, at).check_header(header);
}

PointCloud read_xyz_piece(const ShapeSource& source, const std::vector<std::string>& names,
                          std::size_t columns, bool pwn) {
  return XyzReader(source, pwn).read_piece(names, columns);
}

bool looks_like_xyz(std::span<const char> bytes) {
  TextCursor text(bytes);
  const XyzHeader header = take_xyz_header(text);
  return header.columns >= 3 && (header.names.empty() || has_position(header.names));
}

}  // namespace rholm
