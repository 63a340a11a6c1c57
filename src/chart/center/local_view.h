// Shows a mesh in its unit frame, without a copy of its arrays. Layer: chart.
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

// A plane whose direction is known to this angle counts as exact. Chosen: the centre then moves by
// less than this part of the size, and a wall seen edge-on stays edge-on.
inline constexpr double kKnownPlane = 1e-2;

// The plane normal . x = offset, with x in local coordinates of a UnitFrame. The normal has length
// 1, or 0 for a triangle without a plane: one thinner than the rounding of its coordinates.
struct FacePlane {
  Vec3 normal;
  double offset = 0;
  double turn = 0;  // angle by which rounding may turn the plane, see PlaneUncertainty::turn
  bool exists() const { return normal != Vec3{}; }
  double distance(const Vec3& x) const { return offset - dot(normal, x); }  // d_T seen from x
  double slack() const { return turn > kKnownPlane ? turn : 0; }
  // Upper bound of d_T of every plane within the rounding, seen from any point of the unit frame.
  // No part of the frame is farther from a corner than the frame's diagonal.
  double most_distance(const Vec3& x) const { return distance(x) + kFrameDiagonal * slack(); }
  static constexpr double kFrameDiagonal = 3.5;  // above 2 sqrt(3)
};

struct LocalView {
  MeshView mesh;
  UnitFrame frame;
  Vec3 error;  // coordinate_error() in the unit of the frame
  mutable std::optional<bool> known_closed = {};

  // Returns is_closed(mesh), computed at the first call. Only one thread at a time may call it.
  bool closed() const;

  // Corners are scaled, not moved (see face_normal()). Both throw InvalidInput for a wrong index.
  std::array<Vec3, 3> corners(std::size_t triangle) const;
  FacePlane plane(std::size_t triangle) const;
};

// Reads the vertices once, for the frame. Throws InvalidInput if a coordinate is not finite, or if
// no triangle has a positive area; indices are checked when triangles are read.
LocalView local_view(const MeshView& mesh, const Context& context);

// Type of a function that is called for each triangle a pass has chosen.
using VisitTriangle = std::function<void(std::size_t triangle)>;

// Returns the size of chunks: a few hundred chunks of 5 to 20 us (chosen), more for large meshes.
inline std::size_t triangle_grain(std::size_t n_faces) {
  return std::clamp<std::size_t>(n_faces / 256, 1024, 4096);
}

}  // namespace rholm
