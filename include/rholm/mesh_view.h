// A mesh in memory owned by others: arrays of a program, or a mapped file. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>

#include "rholm/mesh.h"

namespace rholm {

// Vertices and faces at fixed strides in memory, in native byte order. Nothing needs to be aligned.
// The view owns no memory.
struct MeshView {
  // Vertex i has its coordinates x, y, z one after the other at vertices + i * vertex_stride.
  const std::byte* vertices = nullptr;
  std::size_t n_vertices = 0;                    // number of vertices
  std::size_t vertex_stride = 0;                 // bytes between consecutive vertices
  ScalarType coordinate = ScalarType::kFloat64;  // or kFloat32
  // Face t has its three 32-bit vertex indices one after the other at faces + t *
  // face_stride, counter-clockwise from outside.
  const std::byte* faces = nullptr;
  std::size_t n_faces = 0;      // number of faces
  std::size_t face_stride = 0;  // bytes between consecutive faces

  // Returns vertex i < n_vertices; not checked.
  Vec3 vertex(std::size_t i) const {
    const std::byte* at = vertices + i * vertex_stride;
    if (coordinate == ScalarType::kFloat32) {
      float v[3];
      std::memcpy(v, at, sizeof v);
      return {v[0], v[1], v[2]};
    }
    double v[3];
    std::memcpy(v, at, sizeof v);
    return {v[0], v[1], v[2]};
  }
  // Returns face t < n_faces; neither t nor the indices are checked.
  Triangle triangle(std::size_t t) const {
    Triangle corners;
    std::memcpy(corners.data(), faces + t * face_stride, sizeof corners);
    return corners;
  }
};

// Returns a view that is valid while the mesh exists and does not change.
MeshView view_of(const Mesh& mesh);
// Returns a copy of the viewed mesh, without attributes. Nothing is checked.
Mesh mesh_of(const MeshView& view);

// A mesh that need not fit in memory, with functions that remove used rows from memory. A removed
// row is loaded again when it is used. Without a function rows stay in memory.
struct MeshInPlace {
  MeshView mesh;                                                                // not copied
  std::function<void(std::size_t first, std::size_t n)> release_vertices = {};  // n vertices
  std::function<void(std::size_t first, std::size_t n)> release_faces = {};     // n faces
};

// Throws InvalidInput unless every coordinate is finite and every index is below the number of
// vertices.
void validate(const MeshView& mesh);

}  // namespace rholm
