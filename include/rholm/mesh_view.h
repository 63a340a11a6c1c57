// A triangle mesh where it lies: arrays of another program, or the bytes of a file. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "rholm/mesh.h"

namespace rholm {

// Vertex i has its coordinates x, y, z one after the other at vertices + i * vertex_stride, of type
// float32 or float64; triangle t its three 32-bit vertex indices one after the other at triangles +
// t * triangle_stride, counter-clockwise from outside. Native byte order; nothing needs to be
// aligned. The view owns nothing.
struct MeshView {
  const std::byte* vertices = nullptr;
  std::size_t n_vertices = 0;
  std::size_t vertex_stride = 0;
  ScalarType coordinate = ScalarType::kFloat64;
  const std::byte* triangles = nullptr;
  std::size_t n_triangles = 0;
  std::size_t triangle_stride = 0;

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
  Triangle triangle(std::size_t t) const {
    Triangle corners;
    std::memcpy(corners.data(), triangles + t * triangle_stride, sizeof corners);
    return corners;
  }
};

MeshView view_of(const Mesh& mesh);

// Throws InvalidInput unless every coordinate is finite and every index is below the number of
// vertices.
void validate(const MeshView& mesh);

}  // namespace rholm
