// OBJ: positions with colours, texture coordinates and normals, one of each per vertex.
#include "io/shapes/shape_writers.h"

namespace rholm {
namespace {

// Colours of OBJ files run from 0 to 1.
double color_value(const Attribute& attribute, std::size_t i) {
  return attribute.type == ScalarType::kUint8 ? attribute.values[i] / 255 : attribute.values[i];
}

void put_positions(const ShapeView& shape, OutputBuffer& out) {
  const auto colors = find_group<3>(shape.attributes, {"red", "green", "blue"});
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    out.text("v ");
    put_vector(shape.points[i], colors ? ' ' : '\n', out);
    if (colors) {
      const auto& [red, green, blue] = *colors;
      put_vector({color_value(*red, i), color_value(*green, i), color_value(*blue, i)}, '\n', out);
    }
    out.rows(1);
  }
}

// a, a/a, a//a or a/a/a
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

void format_obj(const ShapeView& shape, OutputBuffer& out) {
  put_positions(shape, out);
  const auto texture = find_texture(shape.attributes);
  if (texture) {
    for (std::size_t i = 0; i < shape.points.size(); ++i) {
      out.text("vt ");
      out.number((*texture)[0]->values[i], ' ');
      out.number((*texture)[1]->values[i], '\n');
    }
  }
  const std::vector<Vec3> normals = normals_of(shape);
  for (const Vec3& normal : normals) {
    out.text("vn ");
    put_vector(normal, '\n', out);
  }
  for (const Triangle& t : shape.triangles) {
    out.text("f");
    for (const std::uint32_t corner : t) {
      put_corner(corner, texture.has_value(), !normals.empty(), out);
    }
    out.text("\n");
    out.rows(1);
  }
}

}  // namespace rholm
