// Normals of triangles that stay right for slivers, and the frame in which squares and cubes of
// lengths neither over- nor underflow.
#pragma once

#include <array>

#include "rholm/mesh_view.h"
#include "rholm/topology.h"

namespace rholm {

// A shape's place and size: x -> scale * x - center has extents between 1 and 2 (0 for a point),
// and its middle at 0. The scale is a power of two, so that scaling rounds nothing; it is
// 2^exponent.
struct UnitFrame {
  Vec3 center;  // scaled already
  double scale = 1;
  int exponent = 0;
  Vec3 to_local(const Vec3& x) const { return scale * x - center; }
  Vec3 to_shape(const Vec3& local) const { return (local + center) / scale; }
};
UnitFrame unit_frame(const Bounds& bounds);

struct FaceNormal {
  Vec3 twice_area;  // vector of length twice the area, along the outward normal
  // The height over the longest edge is within the rounding of the coordinates (4 ulp of the
  // largest): the normal's direction means nothing.
  bool degenerate = false;
};
// Corners with moduli below about 1e70 (see UnitFrame); not yet moved, so that rounding is known.
FaceNormal face_normal(const std::array<Vec3, 3>& corners);

// Corners of a triangle, scaled, but not moved.
inline std::array<Vec3, 3> scaled_corners(const Mesh& mesh, const Triangle& t, double scale) {
  return {scale * mesh.vertices[t[0]], scale * mesh.vertices[t[1]], scale * mesh.vertices[t[2]]};
}
inline std::array<Vec3, 3> scaled_corners(const MeshView& mesh, const Triangle& t, double scale) {
  return {scale * mesh.vertex(t[0]), scale * mesh.vertex(t[1]), scale * mesh.vertex(t[2])};
}

}  // namespace rholm
