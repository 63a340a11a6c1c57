#include "io/shapes/plate_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/file/number_text.h"
#include "io/shapes/text_table.h"

namespace rholm {
namespace {

constexpr std::size_t kMostValues = 5;  // per row; longer rows are not part of a plate model

// The values of a row; n is above kMostValues if the row is longer or has a cell without a number.
struct Row {
  std::array<double, kMostValues> values = {};
  std::size_t n = 0;
  bool whole() const {
    return std::all_of(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n),
                       [](double v) { return v == std::floor(v) && std::abs(v) < 1e15; });
  }
};

class Rows {
 public:
  explicit Rows(std::span<const char> bytes) : text(bytes), rows_(text, blanks_) {}
  bool next(Row& row) {
    if (!rows_.next_row()) return false;
    begin = text;
    row.n = 0;
    TableCell cell;
    while (row.n <= kMostValues && rows_.take_cell(cell)) {
      if (row.n == kMostValues || cell.kind != CellKind::kNumber) {
        row.n = kMostValues + 1;
      } else {
        row.values[row.n++] = cell.value;
      }
    }
    rows_.end_row();
    return true;
  }
  bool skip() {
    if (!rows_.next_row()) return false;
    rows_.end_row();
    return true;
  }
  TextCursor text;
  TextCursor begin = text;  // start of the last row

 private:
  TableSyntax blanks_;
  TableRows rows_;
};

bool is_count(double value) { return value >= 3 && value < 4294967295.0; }

// Reads the counts from the first row of a plate model; `plates` is 0 if its count comes later.
bool take_counts(const Row& row, double& vertices, double& plates) {
  if ((row.n != 1 && row.n != 2) || !row.whole() || !is_count(row.values[0])) return false;
  if (row.n == 2 && !(row.values[1] >= 1 && row.values[1] < 4294967295.0)) return false;
  vertices = row.values[0];
  plates = row.n == 2 ? row.values[1] : 0;
  return true;
}

class PlateReader {
 public:
  explicit PlateReader(const ShapeSource& source) : source_(source), rows_(source.bytes) {}

  ShapeFile read() {
    double n_vertices = 0, n_plates = 0;
    next();
    take_counts(row_, n_vertices, n_plates);
    read_vertices(static_cast<std::size_t>(n_vertices));
    if (n_plates == 0) {
      if (!rows_.next(row_)) source_.fail("ends before the number of its plates");
      if (row_.n != 1 || !row_.whole() || !(row_.values[0] >= 1)) {
        fail_row("is where the number of plates should be, behind " +
                 std::to_string(vertices_.size()) + " vertices");
      }
      n_plates = row_.values[0];
    }
    read_plates(static_cast<std::size_t>(n_plates));
    ShapeFile file;
    Mesh mesh{.vertices = {}, .faces = triangles(), .attributes = {}};
    mesh.vertices = std::move(vertices_);
    file.shape = std::move(mesh);
    file.format = ShapeFormat::kXyz;
    file.encoding = "ascii";
    file.table.note = "a plate model: a table of vertices and one of plates";
    std::size_t rest = 0;
    while (rows_.skip()) ++rest;
    if (rest > 0)
      file.warnings.push_back(counted(rest, "row", "rows") + " after the last plate passed over");
    return file;
  }

 private:
  void next() {
    if (!rows_.next(row_)) {
      source_.fail("truncated: the file ends after " +
                   (plates_.empty() ? counted(vertices_.size(), "vertex", "vertices")
                                    : counted(plates_.size(), "plate", "plates")) +
                   " of a plate model");
    }
    source_.progress(rows_.text.at);
  }

  void read_vertices(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      next();
      if (row_.n != 3 && row_.n != 4)
        fail_row("is no vertex of a plate model: x y z, or number x y z");
      if (i == 0) numbered_ = row_.n == 4;
      if (numbered_ != (row_.n == 4))
        fail_row("has another number of values than the first vertex");
      if (i == 0 && numbered_) first_ = row_.values[0];
      if (numbered_ && row_.values[0] != first_ + static_cast<double>(i)) {
        fail_row("numbers vertex " + std::to_string(i) + " out of turn");
      }
      const std::size_t k = row_.n - 3;
      const Vec3 p = {row_.values[k], row_.values[k + 1], row_.values[k + 2]};
      if (!is_finite(p)) fail_row("a coordinate is not a finite number");
      vertices_.push_back(p);
    }
  }

  void read_plates(std::size_t n) {
    bool all_threes = true, all_numbered = true;
    for (std::size_t i = 0; i < n; ++i) {
      next();
      if (row_.n == 1 && row_.values[0] == 3) next();
      if ((row_.n != 3 && row_.n != 4) || !row_.whole()) {
        fail_row("is no plate: three numbers of vertices, or number and three of them");
      }
      const std::size_t k = row_.n - 3;
      if (k == 1) {
        all_threes = all_threes && row_.values[0] == 3;
        if (i == 0) first_plate_ = row_.values[0];
        all_numbered = all_numbered && row_.values[0] == first_plate_ + static_cast<double>(i);
        if (!all_threes && !all_numbered)
          fail_row("numbers plate " + std::to_string(i) + " out of turn");
      }
      plates_.push_back({row_.values[k], row_.values[k + 1], row_.values[k + 2]});
    }
  }

  // Vertices keep their own numbers, or count from 0 if a plate uses 0, and otherwise from 1.
  std::vector<Triangle> triangles() const {
    double base = first_;
    if (!numbered_) {
      base = 1;
      for (const auto& plate : plates_) {
        if (*std::min_element(plate.begin(), plate.end()) == 0) base = 0;
      }
    }
    std::vector<Triangle> all;
    all.reserve(plates_.size());
    for (std::size_t i = 0; i < plates_.size(); ++i) {
      Triangle triangle = {};
      for (std::size_t k = 0; k < 3; ++k) {
        const double index = plates_[i][k] - base;
        if (!(index >= 0 && index < static_cast<double>(vertices_.size()))) {
          char digits[kMaxNumberLength];
          source_.fail("plate " + std::to_string(i) + " names vertex " +
                       std::string(digits, format_number(digits, plates_[i][k])) + ", but the " +
                       std::to_string(vertices_.size()) + " vertices are numbered from " +
                       std::to_string(static_cast<long long>(base)));
        }
        triangle[k] = static_cast<std::uint32_t>(index);
      }
      all.push_back(triangle);
    }
    return all;
  }

  [[noreturn]] void fail_row(const std::string& what) const {
    fail_at_line(source_.name, rows_.begin, what);
  }

  const ShapeSource& source_;
  Rows rows_;
  Row row_;
  bool numbered_ = false;
  double first_ = 1, first_plate_ = 0;
  std::vector<Vec3> vertices_;
  std::vector<std::array<double, 3>> plates_;
};

}  // namespace

// Returns true for a count, as many rows of three or four numbers, and then a single count, or for
// two counts. (One count before all rows belongs to PWN or PTS.)
bool looks_like_plate_table(std::span<const char> bytes) {
  Rows rows(bytes);
  Row row;
  double vertices = 0, plates = 0;
  if (!rows.next(row) || !take_counts(row, vertices, plates)) return false;
  if (vertices > static_cast<double>(bytes.size()) / 6) return false;  // "0 0 0\n"
  if (!rows.next(row) || (row.n != 3 && row.n != 4)) return false;
  for (double i = 1; i < vertices; ++i) {
    if (!rows.skip()) return false;
  }
  if (!rows.next(row)) return false;
  return plates > 0 ? row.n == 1 || row.n == 3 || row.n == 4 : row.n == 1 && row.whole();
}

ShapeFile read_plate_table(const ShapeSource& source) { return PlateReader(source).read(); }

}  // namespace rholm
