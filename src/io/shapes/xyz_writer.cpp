// XYZ: positions, and normals behind them.
#include "io/shapes/shape_writers.h"
#include "io/shapes/xyz_columns.h"

namespace rholm {

void format_xyz(const ShapeView& shape, OutputBuffer& out) {
  const std::vector<Vec3> normals = normals_of(shape);
  // Normals of other lengths than 1 need their names to be known again.
  if (!normals.empty() && !are_unit_normals(normals)) out.text("# x y z nx ny nz\n");
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    put_vector(shape.points[i], normals.empty() ? '\n' : ' ', out);
    if (!normals.empty()) put_vector(normals[i], '\n', out);
    out.rows(1);
  }
}

}  // namespace rholm
