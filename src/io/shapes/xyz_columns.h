// What the columns of a text file of points mean. Layer: io.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

struct ColumnRoles {
  std::array<std::size_t, 3> position = {0, 1, 2};
  std::vector<std::size_t> others;  // all columns but those of the position, in order
  std::vector<std::string> names;   // of all columns; empty if the file does not name them
};

// Whether there are x, y and z among the names (in either case; ParaView's Points:0 ... too).
bool has_position(const std::vector<std::string>& names);

// `names` are empty, or `n` with a position among them.
ColumnRoles column_roles(const std::vector<std::string>& names, std::size_t n);

// Turns columns into normals and attributes; `columns` holds the values of roles.others. Without
// names the values decide what they are, see xyz_reader.cpp; `first_are_normals` says that they are
// normals whatever they look like.
void take_columns(PointCloud& cloud, const ColumnRoles& roles,
                  std::vector<std::vector<double>>& columns, bool first_are_normals);

// Whether vectors are all of length 1 to 1 % (written with two digits or more), or zero, and some
// not zero.
class UnitVectors {
 public:
  void add(const Vec3& v);
  bool all_are() const { return some_ && !other_; }

 private:
  bool some_ = false, other_ = false;
};

}  // namespace rholm
