// A mesh in its unit frame, where it lies: no array of its own. Layer: chart.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "shape/face.h"

namespace rholm {

// normal . x = offset, x in the local coordinates of a UnitFrame; the normal has length 1, or 0 for
// a degenerate triangle, which has no plane.
struct FacePlane {
  Vec3 normal;
  double offset = 0;
  bool exists() const { return normal != Vec3{}; }
  double distance(const Vec3& x) const { return offset - dot(normal, x); }  // d_T seen from x
};

struct LocalView {
  MeshView mesh;
  UnitFrame frame;
  mutable std::optional<bool> known_closed = {};

  // is_closed() of the mesh, found out when it is first asked for. Not by two threads at a time.
  bool closed() const;

  // Scaled, but not moved: see face_normal(). Both throw InvalidInput for an index out of range.
  std::array<Vec3, 3> corners(std::size_t triangle) const;
  FacePlane plane(std::size_t triangle) const;
};

// Reads the vertices once, for the frame. Throws InvalidInput if a coordinate is not finite, or for
// a mesh without a triangle of positive area; indices are checked when triangles are read.
LocalView local_view(const MeshView& mesh, const Context& context);

// Unit outward normal of a triangle, zero if it is degenerate. Corners are scaled, not moved.
Vec3 unit_normal(const std::array<Vec3, 3>& corners);

// Chunks of loops over triangles: a few hundred of 5 to 20 us (chosen), more for large meshes.
inline std::size_t triangle_grain(std::size_t n_triangles) {
  return std::clamp<std::size_t>(n_triangles / 256, 1024, 4096);
}

}  // namespace rholm
