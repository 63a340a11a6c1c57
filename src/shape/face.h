// Computes normals of triangles that stay accurate for slivers, and a frame in which squares and
// cubes of lengths neither overflow nor underflow.
#pragma once

#include <array>

#include "rholm/mesh_view.h"
#include "rholm/topology.h"

namespace rholm {

// Place and size of a shape: x -> scale * x - center has extents between 1 and 2 (0 for a
// point) and its middle at 0. The scale is the power of two 2^exponent, so that scaling does
// not round.
struct UnitFrame {
  Vec3 center;  // already multiplied by the scale
  double scale = 1;
  int exponent = 0;
  Vec3 to_local(const Vec3& x) const { return scale * x - center; }
  Vec3 to_shape(const Vec3& local) const { return (local + center) / scale; }
};
UnitFrame unit_frame(const Bounds& bounds);

struct FaceNormal {
  Vec3 twice_area;  // vector along the outward normal whose length is twice the area
  // True if the height over the longest edge is within the rounding of the coordinates (4 ulp of
  // the largest one). Then the direction of the normal is meaningless.
  bool degenerate = false;
};
// Moduli of corners are below 1e70 (see UnitFrame). Corners are not moved: their rounding is known.
FaceNormal face_normal(const std::array<Vec3, 3>& corners);

// Returns the corners of a triangle, scaled but not moved.
inline std::array<Vec3, 3> scaled_corners(const Mesh& mesh, const Triangle& t, double scale) {
  return {scale * mesh.vertices[t[0]], scale * mesh.vertices[t[1]], scale * mesh.vertices[t[2]]};
}
inline std::array<Vec3, 3> scaled_corners(const MeshView& mesh, const Triangle& t, double scale) {
  return {scale * mesh.vertex(t[0]), scale * mesh.vertex(t[1]), scale * mesh.vertex(t[2])};
}

}  // namespace rholm
