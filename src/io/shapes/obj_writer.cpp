// OBJ: positions with colours, texture coordinates and normals, one of each per vertex.
#include "io/shapes/shape_writers.h"

namespace rholm {
namespace {

// Returns a colour in the range of OBJ files, 0 to 1.
double color_value(const ScalarRange& color, std::size_t i) {
  return color.type == ScalarType::kUint8 ? color[i] / 255 : color[i];
}

void put_positions(const ShapeView& shape, OutputBuffer& out) {
  const auto colors = find_group<3, ScalarRange>(shape.attributes, {"red", "green", "blue"});
  shape.points.visit([&](std::size_t i, const Vec3& point) {
    out.text("v ");
    put_vector(point, colors ? ' ' : '\n', out);
    if (colors) {
      const auto& [red, green, blue] = *colors;
      put_vector({color_value(*red, i), color_value(*green, i), color_value(*blue, i)}, '\n', out);
    }
    out.rows(1);
  });
}

// Writes a, a/a, a//a or a/a/a.
void put_corner(std::uint32_t vertex, bool texture, bool normal, OutputBuffer& out) {
  const std::uint64_t index = std::uint64_t{vertex} + 1;
  out.text(" ");
  out.number(index);
  if (texture) {
    out.text("/");
    out.number(index);
  }
  if (normal) {
    out.text(texture ? "/" : "//");
    out.number(index);
  }
}

}  // namespace

std::vector<std::string> format_obj(const ShapeView& shape, const ShapeWriting&,
                                    OutputBuffer& out) {
  put_positions(shape, out);
  const auto texture = find_texture<ScalarRange>(shape.attributes);
  if (texture) {
    const auto& [u, v] = *texture;
    shape.points.visit_numbers([&](std::size_t i) {
      out.text("vt ");
      out.number((*u)[i], ' ');
      out.number((*v)[i], '\n');
    });
  }
  const NormalRange normals(shape);
  if (!normals.empty()) {
    shape.points.visit_numbers([&](std::size_t i) {
      out.text("vn ");
      put_vector(normals[i], '\n', out);
    });
  }
  shape.faces.visit([&](std::size_t, const Triangle& t) {
    out.text("f");
    for (const std::uint32_t corner : t) {
      put_corner(corner, texture.has_value(), !normals.empty(), out);
    }
    out.text("\n");
    out.rows(1);
  });
  return {};
}

}  // namespace rholm
