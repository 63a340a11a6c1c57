// A triangle mesh where it lies: arrays of another program, or the bytes of a file. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>

#include "rholm/mesh.h"

namespace rholm {

// Vertices and triangles at fixed distances in memory. Native byte order; nothing needs to be
// aligned. The view owns nothing.
struct MeshView {
  // Vertex i has its coordinates x, y, z one after the other at vertices + i * vertex_stride.
  const std::byte* vertices = nullptr;
  std::size_t n_vertices = 0;                    // how many
  std::size_t vertex_stride = 0;                 // bytes from one to the next
  ScalarType coordinate = ScalarType::kFloat64;  // or kFloat32
  // Triangle t has its three 32-bit vertex indices one after the other at triangles + t *
  // triangle_stride, counter-clockwise from outside.
  const std::byte* triangles = nullptr;
  std::size_t n_triangles = 0;      // how many
  std::size_t triangle_stride = 0;  // bytes from one to the next

  // Vertex i < n_vertices; not checked.
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
  // Triangle t < n_triangles; not checked, nor are its indices.
  Triangle triangle(std::size_t t) const {
    Triangle corners;
    std::memcpy(corners.data(), triangles + t * triangle_stride, sizeof corners);
    return corners;
  }
};

// Good as long as the mesh is there and does not change.
MeshView view_of(const Mesh& mesh);
// A copy of what the view shows, without attributes. Nothing is checked.
Mesh mesh_of(const MeshView& view);

// A mesh that need not fit in memory, and what takes rows that have been used out of it: they come
// back when they are used again. Without a function rows stay.
struct MeshInPlace {
  MeshView mesh;                                                                 // as it lies
  std::function<void(std::size_t first, std::size_t n)> release_vertices = {};   // n from the first
  std::function<void(std::size_t first, std::size_t n)> release_triangles = {};  // likewise
};

// Throws InvalidInput unless every coordinate is finite and every index is below the number of
// vertices.
void validate(const MeshView& mesh);

}  // namespace rholm
