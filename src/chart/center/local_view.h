// A mesh in its unit frame, where it lies: no array of its own. Layer: chart.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "shape/coordinate_error.h"
#include "shape/face.h"

namespace rholm {

// A plane whose direction is known to this angle counts as it is. Chosen: a centre moves by less
// than as much of the size, and a wall seen edge-on stays one.
inline constexpr double kKnownPlane = 1e-2;

// normal . x = offset, x in the local coordinates of a UnitFrame; the normal has length 1, or 0 for
// a triangle thinner than the rounding of its coordinates, which has no plane.
struct FacePlane {
  Vec3 normal;
  double offset = 0;
  double turn = 0;  // how far rounding may turn the plane, as PlaneDoubt::turn
  bool exists() const { return normal != Vec3{}; }
  double distance(const Vec3& x) const { return offset - dot(normal, x); }  // d_T seen from x
  double slack() const { return turn > kKnownPlane ? turn : 0; }
  // At least d_T of every plane within the rounding, seen from any point of the unit frame: no part
  // of the frame is farther from a corner than its diagonal.
  double most_distance(const Vec3& x) const { return distance(x) + kFrameDiagonal * slack(); }
  static constexpr double kFrameDiagonal = 3.5;  // 2 sqrt(3)
};

struct LocalView {
  MeshView mesh;
  UnitFrame frame;
  Vec3 error;  // coordinate_error(), in the unit of the frame
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

// Called for triangles that a pass has chosen.
using VisitTriangle = std::function<void(std::size_t triangle)>;

// Chunks of loops over triangles: a few hundred of 5 to 20 us (chosen), more for large meshes.
inline std::size_t triangle_grain(std::size_t n_triangles) {
  return std::clamp<std::size_t>(n_triangles / 256, 1024, 4096);
}

}  // namespace rholm
