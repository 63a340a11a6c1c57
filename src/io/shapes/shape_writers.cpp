#include "io/shapes/shape_writers.h"

#include <algorithm>

#include "rholm/error.h"

namespace rholm {
namespace {

template <std::size_t kSize>
void add_group(const AttributeGroup<kSize>& group, std::vector<const Attribute*>& to) {
  if (group) to.insert(to.end(), group->begin(), group->end());
}

// Those that a format other than PLY writes.
std::vector<const Attribute*> written(std::span<const Attribute> attributes, ShapeFormat format) {
  std::vector<const Attribute*> kept;
  if (format == ShapeFormat::kStl) return kept;
  add_group(find_group<3>(attributes, {"nx", "ny", "nz"}), kept);
  if (format == ShapeFormat::kXyz) return kept;
  add_group(find_group<3>(attributes, {"red", "green", "blue"}), kept);
  if (format == ShapeFormat::kOff) {
    add_group(find_group<4>(attributes, {"red", "green", "blue", "alpha"}), kept);
  } else {
    add_group(find_texture(attributes), kept);
  }
  return kept;
}

}  // namespace

std::vector<std::string> attributes_left_out(std::span<const Attribute> attributes,
                                             ShapeFormat format) {
  std::vector<std::string> names;
  if (format == ShapeFormat::kPly) return names;
  const std::vector<const Attribute*> kept = written(attributes, format);
  for (const Attribute& a : attributes) {
    if (std::find(kept.begin(), kept.end(), &a) == kept.end()) names.push_back(a.name);
  }
  return names;
}

ShapeView shape_view_of(const Mesh& mesh) {
  return {.points = mesh.vertices,
          .normals = {},
          .triangles = mesh.triangles,
          .attributes = mesh.attributes,
          .is_mesh = true};
}

ShapeView shape_view_of(const PointCloud& cloud) {
  return {.points = cloud.points,
          .normals = cloud.normals,
          .triangles = {},
          .attributes = cloud.attributes,
          .is_mesh = false};
}

std::vector<Vec3> normals_of(const ShapeView& shape) {
  std::vector<Vec3> normals(shape.normals.begin(), shape.normals.end());
  const auto group = find_group<3>(shape.attributes, {"nx", "ny", "nz"});
  if (!normals.empty() || !group) return normals;
  normals.reserve(shape.points.size());
  const auto& [x, y, z] = *group;
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    normals.push_back({x->values[i], y->values[i], z->values[i]});
  }
  return normals;
}

void format_shape(const ShapeView& shape, ShapeFormat format, bool ascii, const std::string& name,
                  OutputBuffer& out) {
  if (format == ShapeFormat::kStl && !shape.is_mesh) {
    throw Error(ErrorCode::kUnsupported,
                name + ": STL holds facets, not points; write PLY, OBJ, OFF or XYZ");
  }
  if (format == ShapeFormat::kXyz && !shape.triangles.empty()) {
    throw Error(ErrorCode::kUnsupported,
                name + ": XYZ holds points, not triangles; write PLY, OBJ, OFF or STL");
  }
  switch (format) {
    case ShapeFormat::kPly:
      return format_ply(shape, ascii, out);
    case ShapeFormat::kObj:
      return format_obj(shape, out);
    case ShapeFormat::kOff:
      return format_off(shape, out);
    case ShapeFormat::kStl:
      return format_stl(shape, ascii, name, out);
    case ShapeFormat::kXyz:
      return format_xyz(shape, out);
  }
}

}  // namespace rholm
