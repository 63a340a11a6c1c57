// OFF with normals and colours: [C][N]OFF.
#include "io/shapes/shape_writers.h"

namespace rholm {

std::vector<std::string> format_off(const ShapeView& shape, const ShapeWriting&,
                                    OutputBuffer& out) {
  const NormalRange normals(shape);
  std::vector<const ScalarRange*> colors;
  if (const auto group =
          find_group<4, ScalarRange>(shape.attributes, {"red", "green", "blue", "alpha"})) {
    colors.assign(group->begin(), group->end());
  } else if (const auto opaque =
                 find_group<3, ScalarRange>(shape.attributes, {"red", "green", "blue"})) {
    colors.assign(opaque->begin(), opaque->end());
  }
  if (!colors.empty()) out.text("C");
  if (!normals.empty()) out.text("N");
  out.text("OFF\n");
  out.number(shape.points.size(), ' ');
  out.number(shape.triangles.size(), ' ');
  out.text("0\n");
  shape.points.visit([&](std::size_t i, const Vec3& point) {
    put_vector(point, normals.empty() && colors.empty() ? '\n' : ' ', out);
    if (!normals.empty()) put_vector(normals[i], colors.empty() ? '\n' : ' ', out);
    for (const ScalarRange* color : colors) {
      out.number((*color)[i], color == colors.back() ? '\n' : ' ');
    }
    out.rows(1);
  });
  shape.triangles.visit([&](std::size_t, const Triangle& t) {
    out.text("3 ");
    out.number(t[0], ' ');
    out.number(t[1], ' ');
    out.number(t[2], '\n');
    out.rows(1);
  });
  return {};
}

}  // namespace rholm
