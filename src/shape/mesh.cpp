#include "rholm/mesh.h"

#include <cmath>

#include "rholm/error.h"

namespace rholm {
namespace {

void check_points(const std::vector<Vec3>& points, const char* what) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) {
      throw Error(ErrorCode::kInvalidInput, std::string(what) + " " + std::to_string(i) +
                                                " has a coordinate that is not a finite number");
    }
  }
}

void check_attributes(const std::vector<Attribute>& attributes, std::size_t n) {
  for (const Attribute& attribute : attributes) {
    if (attribute.values.size() != n) {
      throw Error(ErrorCode::kInvalidInput, "attribute '" + attribute.name + "' has " +
                                                std::to_string(attribute.values.size()) +
                                                " values for " + std::to_string(n) + " vertices");
    }
  }
}

}  // namespace

const Attribute* find_attribute(const std::vector<Attribute>& attributes, const std::string& name) {
  for (const Attribute& attribute : attributes) {
    if (attribute.name == name) return &attribute;
  }
  return nullptr;
}

void validate(const Mesh& mesh) {
  check_points(mesh.vertices, "vertex");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t index : mesh.triangles[t]) {
      if (index >= mesh.vertices.size()) {
        throw Error(ErrorCode::kInvalidInput, "triangle " + std::to_string(t) + " names vertex " +
                                                  std::to_string(index) + ", but there are only " +
                                                  std::to_string(mesh.vertices.size()));
      }
    }
  }
  check_attributes(mesh.attributes, mesh.vertices.size());
}

void validate(const PointCloud& cloud) {
  check_points(cloud.points, "point");
  check_points(cloud.normals, "normal");
  if (!cloud.normals.empty() && cloud.normals.size() != cloud.points.size()) {
    throw Error(ErrorCode::kInvalidInput, "there are " + std::to_string(cloud.normals.size()) +
                                              " normals for " +
                                              std::to_string(cloud.points.size()) + " points");
  }
  check_attributes(cloud.attributes, cloud.points.size());
}

}  // namespace rholm
