// The planes of a mesh's triangles, in its unit frame.
#pragma once

#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/face.h"

namespace rholm {

// normal . x = offset, x in the local coordinates of a UnitFrame; the normal has length 1, or 0 for
// a degenerate triangle, which has no plane.
struct FacePlane {
  Vec3 normal;
  double offset = 0;
  bool exists() const { return normal != Vec3{}; }
};

struct FacePlanes {
  UnitFrame frame;
  std::vector<FacePlane> planes;  // one per triangle
};

// Throws InvalidInput for a mesh that is not valid or has no triangle of positive area.
FacePlanes face_planes(const Mesh& mesh, const Context& context);

// Unit outward normal of a triangle, zero if it is degenerate. Corners are scaled, not moved.
Vec3 unit_normal(const std::array<Vec3, 3>& corners);

// Chunks of loops over triangles: a few hundred, large enough to outweigh their start (chosen).
std::size_t triangle_grain(std::size_t n_triangles);

}  // namespace rholm
