#include "rholm/mesh.h"

#include <cmath>

#include "base/cancel.h"
#include "rholm/error.h"
#include "rholm/mesh_view.h"

namespace rholm {
namespace {

void check_point(const Vec3& point, std::size_t i, const char* what) {
  if (!is_finite(point)) {
    throw Error(ErrorCode::kInvalidInput, std::string(what) + " " + std::to_string(i) +
                                              " has a coordinate that is not a finite number");
  }
}

void check_points(const std::vector<Vec3>& points, const char* what) {
  CancelPoll poll;
  for (std::size_t i = 0; i < points.size(); ++i) {
    poll();
    check_point(points[i], i, what);
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

void set_attribute(std::vector<Attribute>& attributes, Attribute attribute) {
  std::erase_if(attributes, [&](const Attribute& a) { return a.name == attribute.name; });
  attributes.push_back(std::move(attribute));
}

MeshView view_of(const Mesh& mesh) {
  return {.vertices = reinterpret_cast<const std::byte*>(mesh.vertices.data()),
          .n_vertices = mesh.vertices.size(),
          .vertex_stride = sizeof(Vec3),
          .coordinate = ScalarType::kFloat64,
          .faces = reinterpret_cast<const std::byte*>(mesh.faces.data()),
          .n_faces = mesh.faces.size(),
          .face_stride = sizeof(Triangle)};
}

Mesh mesh_of(const MeshView& view) {
  Mesh mesh;
  mesh.vertices.reserve(view.n_vertices);
  mesh.faces.reserve(view.n_faces);
  CancelPoll poll;
  for (std::size_t i = 0; i < view.n_vertices; ++i) {
    poll();
    mesh.vertices.push_back(view.vertex(i));
  }
  for (std::size_t t = 0; t < view.n_faces; ++t) {
    poll();
    mesh.faces.push_back(view.triangle(t));
  }
  return mesh;
}

void validate(const MeshView& mesh) {
  CancelPoll poll;
  for (std::size_t i = 0; i < mesh.n_vertices; ++i) {
    poll();
    check_point(mesh.vertex(i), i, "vertex");
  }
  for (std::size_t t = 0; t < mesh.n_faces; ++t) {
    poll();
    for (const std::uint32_t index : mesh.triangle(t)) {
      if (index >= mesh.n_vertices) {
        // Negative indices of the input appear here as large unsigned numbers.
        const bool negative = index > INT32_MAX;
        throw Error(
            ErrorCode::kInvalidInput,
            "face " + std::to_string(t) + " names vertex " +
                (negative ? std::to_string(static_cast<std::int32_t>(index))
                          : std::to_string(index)) +
                (negative ? ", but indices begin at 0 and end at " : ", but the last one is ") +
                (mesh.n_vertices > 0 ? std::to_string(mesh.n_vertices - 1) : "none"));
      }
    }
  }
}

void validate(const Mesh& mesh) {
  validate(view_of(mesh));
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
