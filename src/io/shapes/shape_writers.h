// The writers of shapes. Layer: io.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/file/output_buffer.h"
#include "rholm/mesh.h"
#include "rholm/shape_io.h"

namespace rholm {

// A mesh or points, as writers see them.
struct ShapeView {
  std::span<const Vec3> points;
  std::span<const Vec3> normals;  // of points; those of a mesh are attributes
  std::span<const Triangle> triangles;
  std::span<const Attribute> attributes;
  bool is_mesh = false;
};
ShapeView shape_view_of(const Mesh& mesh);
ShapeView shape_view_of(const PointCloud& cloud);

// Writes a valid shape. Throws Unsupported if the format cannot hold it, InvalidInput if a
// coordinate does not fit; `name` serves messages.
void format_shape(const ShapeView& shape, ShapeFormat format, bool ascii, const std::string& name,
                  OutputBuffer& out);

void format_ply(const ShapeView& shape, bool ascii, OutputBuffer& out);
void format_obj(const ShapeView& shape, OutputBuffer& out);
void format_off(const ShapeView& shape, OutputBuffer& out);
void format_stl(const ShapeView& shape, bool ascii, const std::string& name, OutputBuffer& out);
void format_xyz(const ShapeView& shape, OutputBuffer& out);

// Several attributes that belong together, if all are there.
template <std::size_t kSize>
using AttributeGroup = std::optional<std::array<const Attribute*, kSize>>;
template <std::size_t kSize>
AttributeGroup<kSize> find_group(std::span<const Attribute> attributes,
                                 const std::array<const char*, kSize>& names) {
  std::array<const Attribute*, kSize> group = {};
  for (std::size_t k = 0; k < kSize; ++k) {
    for (const Attribute& a : attributes) {
      if (group[k] == nullptr && a.name == names[k]) group[k] = &a;
    }
    if (group[k] == nullptr) return std::nullopt;
  }
  return group;
}

// The names that texture coordinates go by.
inline AttributeGroup<2> find_texture(std::span<const Attribute> attributes) {
  for (const std::array<const char*, 2>& names :
       {std::array{"u", "v"}, std::array{"s", "t"}, std::array{"texture_u", "texture_v"}}) {
    if (auto group = find_group<2>(attributes, names)) return group;
  }
  return std::nullopt;
}

// One normal per point or vertex, from where they are; empty if there are none.
std::vector<Vec3> normals_of(const ShapeView& shape);

// The numbers of a position or normal and a blank between each.
inline void put_vector(const Vec3& v, char last, OutputBuffer& out) {
  out.number(v.x, ' ');
  out.number(v.y, ' ');
  out.number(v.z, last);
}

}  // namespace rholm
