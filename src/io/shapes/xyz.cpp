// Points as lines of numbers (XYZ, PWN, PTS, TXT, CSV), with any columns after the position.
//
// text_table.h splits rows into cells, xyz_columns.h finds the meaning of the columns. The first
// line may be the number of points (PWN, PTS). In a PWN file, normals follow the position in each
// row, or are lines of their own after all positions.
#include "io/shapes/xyz.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/plain_text.h"
#include "io/file/number_text.h"
#include "io/shapes/plate_table.h"
#include "io/shapes/shape_source.h"
#include "io/shapes/shape_writers.h"
#include "io/shapes/xyz_columns.h"
#include "rholm/error.h"

namespace rholm {
namespace {

class XyzReader {
 public:
  XyzReader(const ShapeSource& source, const TableLook& look, std::size_t at)
      : source_(source), look_(look), text_(source.bytes) {
    text_.at += std::min(at, source.bytes.size());
  }

  void read_rows(PointColumns& points) {
    const std::size_t n = look_.header.syntax.columns;
    std::vector<double> row(n);
    TableRows rows(text_, look_.header.syntax);
    for (std::size_t i = 0; rows.next_row(); ++i) {
      for (std::size_t k = 0; k < n; ++k) {
        if (!rows.take_plain_number(row[k])) row[k] = take_other(rows, k);
      }
      TableCell more;
      if (rows.take_cell(more)) {
        fail_line("has more values than the first line, which has " + std::to_string(n));
      }
      rows.end_row();
      points.add(row);
      if (i % 256 == 0) source_.progress(text_.at);
    }
  }

 private:
  // Reads a cell that is no plain number, or reports a missing cell.
  double take_other(TableRows& rows, std::size_t k) {
    TableCell cell;
    const TextCursor before = text_;
    if (!rows.take_cell(cell)) {
      fail_line("has " + counted(k, "value", "values") + ", the first line has " +
                std::to_string(look_.header.syntax.columns));
    }
    if (cell.kind == CellKind::kText && look_.plan.roles[k] != ColumnRole::kSkipped) {
      text_ = before;
      fail_line(in_quotes(cell.text) + " is not a number");
    }
    return cell.kind == CellKind::kNumber ? cell.value : std::numeric_limits<double>::quiet_NaN();
  }

  [[noreturn]] void fail_line(const std::string& what) const {
    fail_at_line(source_.name, text_, what, source_.lines_before);
  }

  const ShapeSource& source_;
  const TableLook& look_;
  TextCursor text_;
};

// Throws InvalidInput for a header that no points can follow.
void check_header(const ShapeSource& source, const TableHeader& header, const std::string& wanted) {
  TextCursor text(source.bytes);
  text.at += header.rows_at;
  const auto fail_line = [&](const std::string& what) { fail_at_line(source.name, text, what); };
  const std::size_t n = header.syntax.columns;
  if (n == 0 && !text.at_end()) fail_line(quoted_word(text) + " does not begin a row of numbers");
  if (n == 0) source.fail("has no points");
  if (n < 3) fail_line("a point needs 3 coordinates, here are " + counted(n, "value", "values"));
  if (!header.unfit_names.empty() && wanted.empty()) {
    fail_line("the header " + in_quotes(header.unfit_names) + " names " +
              counted(header.unfit, "column", "columns") + ", but this line has " +
              counted(n, "value", "values"));
  }
}

// Takes as normals the second half of the rows, if normals follow all positions.
void take_normals_that_follow(PointCloud& cloud) {
  const std::size_t n = cloud.points.size() / 2;
  const auto middle = cloud.points.begin() + static_cast<std::ptrdiff_t>(n);
  cloud.normals.assign(middle, cloud.points.end());
  cloud.points.resize(n);
}

// Gaskell's implicitly connected quadrilaterals have n, and then six faces of (n + 1)^2 points.
bool is_icq(double count, std::size_t rows) {
  return static_cast<double>(rows) == 6 * (count + 1) * (count + 1);
}

void check_count(const ShapeSource& source, const TableHeader& header, std::size_t rows) {
  if (!header.has_count || header.count == static_cast<double>(rows)) return;
  char digits[kMaxNumberLength];
  const std::string count(digits, format_number(digits, header.count));
  if (is_icq(header.count, rows)) {
    source.fail("is a shape model of implicitly connected quadrilaterals (ICQ), " + count +
                " to a side, which is not read: convert it to plates, or delete its first line to "
                "read its points");
  }
  source.fail("its first line promises " + count + " points, but " + std::to_string(rows) +
              " follow");
}

bool ends_with(const std::string& name, const std::string& extension) {
  return lower_case(name).ends_with(extension);
}

}  // namespace

TableLook look_at_points(const ShapeSource& source, bool is_all) {
  TableLook look;
  look.header = look_at_table(source.bytes, is_all);
  check_header(source, look.header, source.columns);
  const TellingRows telling = telling_rows(source.bytes, is_all, look.header);
  try {
    look.plan =
        plan_table(look.header, telling, source.columns,
                   {.normals_follow = ends_with(source.name, ".pwn"),
                    .intensity_first = look.header.has_count || ends_with(source.name, ".pts")});
  } catch (const Error& error) {
    TextCursor text(source.bytes);
    text.at += look.header.rows_at;
    fail_at_line(source.name, text, error.what());
  }
  return look;
}

PointCloud read_xyz_rows(const ShapeSource& source, const TableLook& look, std::size_t at,
                         std::vector<std::string>& warnings) {
  PointColumns points(look.plan, source.attributes);
  XyzReader(source, look, at).read_rows(points);
  PointCloud cloud = points.take();
  settle_attribute_types(cloud.attributes, warnings);
  return cloud;
}

ShapeFile read_xyz(const ShapeSource& source) {
  if (looks_like_plate_table(source.bytes)) return read_plate_table(source);
  ShapeFile file;
  file.format = ShapeFormat::kXyz;
  file.encoding = "ascii";
  TableLook look = look_at_points(source, true);
  PointCloud cloud = read_xyz_rows(source, look, look.header.rows_at, file.warnings);
  const TableHeader& header = look.header;
  const std::size_t rows = cloud.points.size();
  if (header.has_count && header.syntax.columns == 3 &&
      header.count == static_cast<double>(rows) / 2) {
    take_normals_that_follow(cloud);
    look.plan.told.note += "; as many lines of normals follow";
  } else {
    check_count(source, header, rows);
  }
  file.shape = std::move(cloud);
  file.table = std::move(look.plan.told);
  return file;
}

bool may_be_xyz(std::span<const char> bytes) {
  if (looks_like_plate_table(bytes)) return true;
  const TableHeader header = look_at_table(bytes, true);
  if (!header.names.empty() && !has_position(header.names)) return false;
  const TellingRows telling = telling_rows(bytes, true, header);
  return std::count_if(telling.texts.begin(), telling.texts.end(),
                       [&](std::size_t texts) { return texts < telling.rows; }) >= 3;
}

void put_xyz_header(bool names, OutputBuffer& out) {
  if (names) out.text("# x y z nx ny nz\n");
}

void put_xyz_rows(const ShapeView& shape, OutputBuffer& out) {
  const NormalRange normals(shape);
  shape.points.visit([&](std::size_t i, const Vec3& point) {
    put_vector(point, normals.empty() ? '\n' : ' ', out);
    if (!normals.empty()) put_vector(normals[i], '\n', out);
    out.rows(1);
  });
}

std::vector<std::string> format_xyz(const ShapeView& shape, const ShapeWriting&,
                                    OutputBuffer& out) {
  const NormalRange normals(shape);
  XyzNames names;
  if (!normals.empty()) {
    shape.points.visit([&](std::size_t i, const Vec3& p) { names.add(p, normals[i]); });
  }
  put_xyz_header(!normals.empty() && names.are_needed(), out);
  put_xyz_rows(shape, out);
  return {};
}

}  // namespace rholm
