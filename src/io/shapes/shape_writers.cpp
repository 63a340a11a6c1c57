#include "io/shapes/shape_writers.h"

#include <algorithm>

#include "io/file/scalar_bytes.h"
#include "rholm/error.h"

namespace rholm {
namespace {

template <std::size_t kSize>
void add_group(const AttributeGroup<kSize, Attribute>& group, std::vector<const Attribute*>& to) {
  if (group) to.insert(to.end(), group->begin(), group->end());
}

// Those that a format other than PLY writes.
std::vector<const Attribute*> written(std::span<const Attribute> attributes, ShapeFormat format) {
  std::vector<const Attribute*> kept;
  if (format == ShapeFormat::kStl) return kept;
  add_group(find_group<3, Attribute>(attributes, {"nx", "ny", "nz"}), kept);
  if (format == ShapeFormat::kXyz) return kept;
  add_group(find_group<3, Attribute>(attributes, {"red", "green", "blue"}), kept);
  if (format == ShapeFormat::kOff) {
    add_group(find_group<4, Attribute>(attributes, {"red", "green", "blue", "alpha"}), kept);
  } else {
    add_group(find_texture<Attribute>(attributes), kept);
  }
  return kept;
}

std::vector<ScalarRange> scalar_ranges(const std::vector<Attribute>& attributes) {
  return {attributes.begin(), attributes.end()};
}

}  // namespace

void ScalarRange::load(std::size_t begin, std::size_t n, double* to) const {
  if (first_ == nullptr) {
    std::copy_n(values_.data() + begin, n, to);
    return;
  }
  const char* const from = reinterpret_cast<const char*>(first_) + begin * stride_;
  with_scalar_type(type, [&](auto tag) {
    using T = typename decltype(tag)::type;
    for (std::size_t i = 0; i < n; ++i) {
      to[i] = static_cast<double>(rholm::load<T, false>(from + i * stride_));
    }
  });
}

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
  return {.points = PointRange(mesh.vertices),
          .normals = {},
          .triangles = TriangleRange(mesh.triangles),
          .attributes = scalar_ranges(mesh.attributes),
          .is_mesh = true};
}

ShapeView shape_view_of(const PointCloud& cloud) {
  return {.points = PointRange(cloud.points),
          .normals = cloud.normals,
          .triangles = {},
          .attributes = scalar_ranges(cloud.attributes),
          .is_mesh = false};
}

NormalRange::NormalRange(const ShapeView& shape) : vectors_(shape.normals) {
  if (vectors_.empty()) scalars_ = find_group<3, ScalarRange>(shape.attributes, {"nx", "ny", "nz"});
}

std::vector<std::string> format_shape(const ShapeView& shape, ShapeFormat format, bool ascii,
                                      const std::string& name, OutputBuffer& out) {
  if (format == ShapeFormat::kStl && !shape.is_mesh) {
    throw Error(ErrorCode::kUnsupported,
                name + ": STL holds facets, not points; write PLY, OBJ, OFF or XYZ");
  }
  if (format == ShapeFormat::kXyz && shape.triangles.size() > 0) {
    throw Error(ErrorCode::kUnsupported,
                name + ": XYZ holds points, not triangles; write PLY, OBJ, OFF or STL");
  }
  switch (format) {
    case ShapeFormat::kPly:
      format_ply(shape, ascii, out);
      break;
    case ShapeFormat::kObj:
      format_obj(shape, out);
      break;
    case ShapeFormat::kOff:
      format_off(shape, out);
      break;
    case ShapeFormat::kStl:
      return format_stl(shape, ascii, name, out);
    case ShapeFormat::kXyz:
      format_xyz(shape, out);
      break;
  }
  return {};
}

}  // namespace rholm
