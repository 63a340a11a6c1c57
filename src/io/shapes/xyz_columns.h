// Determines the roles of the columns of a table of points from its header and its first rows.
// Layer: io.
//
// Names decide if there are any. Without names the values decide. A first column of growing whole
// numbers counts the rows. The position comes next, then normals and colours in any order, each in
// three adjacent columns. Normals are unit vectors to 1 %, or have lengths 0.75 ... 1.25 and both
// signs. Colours are bytes, or fractions of 1. Other columns are scalars.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/shapes/column_names.h"
#include "io/shapes/text_table.h"
#include "rholm/mesh.h"
#include "rholm/shape_io.h"

namespace rholm {

// Hints from the name of a file or its first lines, beside column names and values.
struct TableHints {
  bool normals_follow = false;   // PWN: normals follow the position
  bool intensity_first = false;  // PTS: one number precedes the colours
};

struct TablePlan {
  std::vector<ColumnRole> roles = {};   // role of each column
  std::vector<std::string> names = {};  // names of scalar attributes, otherwise empty
  bool colatitude = false, west = false, radians = false;  // see NamedRoles
  bool byte_colors = false;
  TableColumns told = {};
};

// Throws InvalidInput if `wanted` (ShapeReadOptions::columns) has another number of columns, if
// names lack a position, or if fewer than three columns hold numbers.
TablePlan plan_table(const TableHeader& header, const TellingRows& telling,
                     const std::string& wanted, const TableHints& hints);

// Collects points row by row.
class PointColumns {
 public:
  // `attributes` is true if colours and scalars are kept.
  PointColumns(const TablePlan& plan, bool attributes);
  void add(std::span<const double> row);  // a value for each column
  std::size_t size() const { return points_.size(); }
  PointCloud take();

 private:
  struct Kept {
    std::size_t column;
    Attribute attribute;
  };
  const TablePlan& plan_;
  bool degrees_ = false;
  std::array<std::size_t, 3> position_ = {}, normal_ = {};
  bool has_normals_ = false;
  std::vector<Vec3> points_, normals_;
  std::vector<Kept> kept_;
};

// Removes points that are not finite from the cloud, and returns their number. Sets normals that
// are not finite to zero.
std::size_t drop_not_finite(PointCloud& cloud);
std::string dropped_warning(std::size_t n);

// Tests that all vectors have length 1 to 1 % (written with two digits or more) or are zero, and
// that some are not zero.
class UnitVectors {
 public:
  void add(const Vec3& v);
  bool all_are() const { return some_ && !other_; }

 private:
  bool some_ = false, other_ = false;
};

// Tests whether points and normals in six columns need column names to be recognised again.
class XyzNames {
 public:
  void add(const Vec3& point, const Vec3& normal);
  bool are_needed() const { return !units_.all_are() || !negative_ || counts_; }

 private:
  UnitVectors units_;
  bool negative_ = false;  // a component of a normal is negative
  bool counts_ = true;     // first coordinates may be row numbers
  double last_ = 0;
  std::size_t n_ = 0;
};

}  // namespace rholm
