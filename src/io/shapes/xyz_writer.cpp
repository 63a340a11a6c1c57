// XYZ: positions, and normals behind them.
#include "io/shapes/shape_writers.h"
#include "io/shapes/xyz_columns.h"

namespace rholm {

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
