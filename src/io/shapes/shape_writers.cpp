#include "io/shapes/shape_writers.h"

#include <algorithm>

#include "io/file/scalar_bytes.h"
#include "rholm/formats.h"

namespace rholm {
namespace {

template <std::size_t kSize>
void add_group(const AttributeGroup<kSize, Attribute>& group, std::vector<const Attribute*>& to) {
  if (group) to.insert(to.end(), group->begin(), group->end());
}

// Returns the attributes that a format writes if it has no room for all.
std::vector<const Attribute*> written(std::span<const Attribute> attributes,
                                      const ShapeFormatInfo& format) {
  std::vector<const Attribute*> kept;
  if (format.normals) add_group(find_group<3, Attribute>(attributes, {"nx", "ny", "nz"}), kept);
  if (format.colors) {
    add_group(find_group<3, Attribute>(attributes, {"red", "green", "blue"}), kept);
  }
  if (format.alpha) {
    add_group(find_group<4, Attribute>(attributes, {"red", "green", "blue", "alpha"}), kept);
  }
  if (format.texture) add_group(find_texture<Attribute>(attributes), kept);
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
  const ShapeFormatInfo& info = shape_format_info(format);
  if (info.any_attributes) return names;
  const std::vector<const Attribute*> kept = written(attributes, info);
  for (const Attribute& a : attributes) {
    if (std::find(kept.begin(), kept.end(), &a) == kept.end()) names.push_back(a.name);
  }
  return names;
}

ShapeView shape_view_of(const Mesh& mesh) {
  return {.points = PointRange(mesh.vertices),
          .normals = {},
          .faces = TriangleRange(mesh.faces),
          .attributes = scalar_ranges(mesh.attributes),
          .is_mesh = true};
}

ShapeView shape_view_of(const PointCloud& cloud) {
  return {.points = PointRange(cloud.points),
          .normals = cloud.normals,
          .faces = {},
          .attributes = scalar_ranges(cloud.attributes),
          .is_mesh = false};
}

NormalRange::NormalRange(const ShapeView& shape) : vectors_(shape.normals) {
  if (vectors_.empty()) scalars_ = find_group<3, ScalarRange>(shape.attributes, {"nx", "ny", "nz"});
}

}  // namespace rholm
