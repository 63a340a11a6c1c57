// What the columns of a table of points are: decided from its header and its first rows together.
// Layer: io.
//
// Names win where there are any. Without names the values decide: a first column of whole numbers
// that only grow counts the rows; then come the position, and in any order, where three columns
// side by side look like it, normals (unit vectors to 1 %, or vectors of length 0.75 ... 1.25 of
// both signs) and colours (bytes, or parts of 1); the rest are scalars.
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

// What a name of a file or its first lines say, beside names and values.
struct TableHints {
  bool normals_follow = false;   // PWN: normals come behind the position
  bool intensity_first = false;  // PTS: one number stands before the colours
};

struct TablePlan {
  std::vector<ColumnRole> roles = {};   // of each column
  std::vector<std::string> names = {};  // of the attributes that scalars become, else empty
  bool colatitude = false, west = false, radians = false;  // as in NamedRoles
  bool byte_colors = false;
  TableColumns told = {};
};

// Throws InvalidInput for `wanted` (ShapeReadOptions::columns) that has another number of columns,
// for names without a position, and where fewer than three columns hold numbers.
TablePlan plan_table(const TableHeader& header, const TellingRows& telling,
                     const std::string& wanted, const TableHints& hints);

// Points row by row.
class PointColumns {
 public:
  // `attributes`: whether colours and scalars are kept.
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

// Takes points whose place is not finite out of the cloud, and returns how many there were. Normals
// that are not finite become zero.
std::size_t drop_not_finite(PointCloud& cloud);
std::string dropped_warning(std::size_t n);

// Whether vectors are all of length 1 to 1 % (written with two digits or more), or zero, and some
// not zero.
class UnitVectors {
 public:
  void add(const Vec3& v);
  bool all_are() const { return some_ && !other_; }

 private:
  bool some_ = false, other_ = false;
};

// Whether points and normals, written as six columns, need names to be taken for these again.
class XyzNames {
 public:
  void add(const Vec3& point, const Vec3& normal);
  bool are_needed() const { return !units_.all_are() || !negative_ || counts_; }

 private:
  UnitVectors units_;
  bool negative_ = false;  // some component of a normal
  bool counts_ = true;     // first coordinates may be numbers of rows
  double last_ = 0;
  std::size_t n_ = 0;
};

}  // namespace rholm
