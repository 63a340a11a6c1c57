// XYZ: positions, and normals behind them.
#include "io/shapes/shape_writers.h"
#include "io/shapes/xyz_columns.h"

namespace rholm {

// Normals of other lengths than 1 need their names to be known again.
void put_xyz_header(bool unit_normals, OutputBuffer& out) {
  if (!unit_normals) out.text("# x y z nx ny nz\n");
}

void put_xyz_rows(const ShapeView& shape, OutputBuffer& out) {
  const NormalRange normals(shape);
  shape.points.visit([&](std::size_t i, const Vec3& point) {
    put_vector(point, normals.empty() ? '\n' : ' ', out);
    if (!normals.empty()) put_vector(normals[i], '\n', out);
    out.rows(1);
  });
}

void format_xyz(const ShapeView& shape, OutputBuffer& out) {
  const NormalRange normals(shape);
  UnitVectors units;
  if (!normals.empty()) shape.points.visit_numbers([&](std::size_t i) { units.add(normals[i]); });
  put_xyz_header(normals.empty() || units.all_are(), out);
  put_xyz_rows(shape, out);
}

}  // namespace rholm
