// Estimates the error of a mesh's coordinates, and the uncertainty of the faces' planes that
// follows from it. Layer: shape.
//
// A mesh stands for an exact surface whose vertices were rounded when they were computed and
// written. The plane of a face that is thinner than this rounding is meaningless. The plane of a
// wider face is known up to an angle.
#pragma once

#include <array>

#include "rholm/mesh_view.h"
#include "shape/face.h"

namespace rholm {

// Returns the largest error of any vertex along each axis, in the unit of the mesh. It is the
// maximum of these values; the last two count only if they leave at least half of the faces
// wider:
// - Double precision: 2^-43 times the largest coordinate on the axis.
// - Single precision, if every coordinate is a float or a float written in decimal: the spacing
//   of floats at the largest coordinate on the axis.
// - Decimals, if every coordinate has 5 to 13 decimal digits: the unit of the last digit.
// `mesh` has finite coordinates. Throws InvalidInput if it meets an index out of range.
Vec3 coordinate_error(const MeshView& mesh);

// Returns true if every coordinate is exactly a single-precision number.
bool is_in_single_precision(const MeshView& mesh);

// Describes how far the errors of its corners leave the plane of a face uncertain.
struct PlaneDoubt {
  bool thin = false;  // true if some triangle within the errors has no area: no plane
  // If not thin: upper bound of the tangent of the angle between this plane and the plane of any
  // triangle within the errors.
  double turn = 0;
};
// Computes the uncertainty of a face's plane. `error` is a result of coordinate_error() in the unit
// of the corners; `normal` is face_normal(corners).
PlaneDoubt plane_doubt(const std::array<Vec3, 3>& corners, const FaceNormal& normal,
                       const Vec3& error);

// Returns true if the face is thinner than the errors of its corners.
bool is_thin(const std::array<Vec3, 3>& corners, const Vec3& error);

}  // namespace rholm
