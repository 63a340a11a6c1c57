// Lines of numbers in two steps, for code that reads a file in blocks. Layer: io.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/shapes/shape_source.h"
#include "io/shapes/text_table.h"
#include "io/shapes/xyz_columns.h"
#include "rholm/mesh.h"

namespace rholm {

// Header and columns of a table of points.
struct TableLook {
  TableHeader header;
  TablePlan plan;
};

// Analyses the start of a file (`is_all`: the whole file). Throws InvalidInput if no points can
// follow, and for ShapeReadOptions::columns that do not fit.
TableLook look_at_points(const ShapeSource& source, bool is_all);

// Returns the points of whole rows, from byte `at` of the source on, including non-finite points.
PointCloud read_xyz_rows(const ShapeSource& source, const TableLook& look, std::size_t at,
                         std::vector<std::string>& warnings);

}  // namespace rholm
