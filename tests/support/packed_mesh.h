// A mesh as the bytes of a file, for tests of views.
#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

#include "rholm/mesh_view.h"

namespace rholm::test {

struct PackedMesh {
  std::vector<std::byte> vertices, faces;  // exactly as many bytes as needed
  MeshView view;
};

// Packs coordinates of type T, with `gap` bytes between vertices; a face takes 13 bytes.
template <class T>
PackedMesh packed(const Mesh& mesh, std::size_t gap = 0) {
  const std::size_t row = 3 * sizeof(T), stride = row + gap, n = mesh.vertices.size();
  PackedMesh result;
  result.vertices.resize(n == 0 ? 0 : stride * (n - 1) + row, std::byte{0x7f});
  result.faces.resize(13 * mesh.faces.size(), std::byte{3});
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& v = mesh.vertices[i];
    const T xyz[3] = {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
    std::memcpy(&result.vertices[stride * i], xyz, row);
  }
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    std::memcpy(&result.faces[13 * t + 1], mesh.faces[t].data(), 12);
  }
  result.view = {.vertices = result.vertices.data(),
                 .n_vertices = n,
                 .vertex_stride = stride,
                 .coordinate = sizeof(T) == 4 ? ScalarType::kFloat32 : ScalarType::kFloat64,
                 .faces = result.faces.data() + 1,
                 .n_faces = mesh.faces.size(),
                 .face_stride = 13};
  return result;
}

// Returns a copy of the mesh that a view shows.
inline Mesh unpacked(const MeshView& view) {
  Mesh mesh;
  for (std::size_t i = 0; i < view.n_vertices; ++i) mesh.vertices.push_back(view.vertex(i));
  for (std::size_t t = 0; t < view.n_faces; ++t) mesh.faces.push_back(view.triangle(t));
  return mesh;
}

}  // namespace rholm::test
