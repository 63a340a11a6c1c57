// Lines of numbers in two steps, for what reads a file in pieces. Layer: io.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/shapes/shape_source.h"
#include "io/shapes/text_table.h"
#include "io/shapes/xyz_columns.h"
#include "rholm/mesh.h"

namespace rholm {

// What a table of points is.
struct TableLook {
  TableHeader header;
  TablePlan plan;
};

// By the begin of a file (`is_all`: the whole of it). Throws InvalidInput for what no points can
// follow, and for ShapeReadOptions::columns that do not fit.
TableLook look_at_points(const ShapeSource& source, bool is_all);

// The points of whole rows, from byte `at` of the source on. Those that are not finite are there.
PointCloud read_xyz_rows(const ShapeSource& source, const TableLook& look, std::size_t at,
                         std::vector<std::string>& warnings);

}  // namespace rholm
