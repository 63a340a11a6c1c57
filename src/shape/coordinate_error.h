// How far the coordinates of a mesh may be from what they stand for, and what that leaves of the
// planes of its triangles. Layer: shape.
//
// A mesh stands for an exact surface whose vertices were rounded when they were computed and
// written. A triangle that is thinner than this rounding has a plane that says nothing. The plane
// of a wider triangle is known up to an angle.
#pragma once

#include <array>

#include "rholm/mesh_view.h"
#include "shape/face.h"

namespace rholm {

// How far each coordinate of every vertex may be from the exact one, along each axis, in the unit
// of the mesh. It is the largest of the following; the last two only where fewer than half of the
// faces would be thinner.
// - Double precision: 2^-43 of the largest coordinate on the axis.
// - All coordinates are numbers of single precision, or such numbers written as decimals: the step
//   of single precision at the largest coordinate on the axis.
// - All coordinates are decimals of 5 to 13 digits: their last digit.
// `mesh` has finite coordinates. Throws InvalidInput for an index out of range that it meets.
Vec3 coordinate_error(const MeshView& mesh);

// Whether all coordinates are numbers of single precision.
bool is_in_single_precision(const MeshView& mesh);

// What the errors of its corners leave of a triangle's plane.
struct PlaneDoubt {
  bool thin = false;  // some triangle within the errors has no area: the plane says nothing
  // If not thin: a bound of the tangent of the angle between this plane and that of any triangle
  // within the errors.
  double turn = 0;
};
// `error` as from coordinate_error(), and corners, both in one unit; `normal`:
// face_normal(corners).
PlaneDoubt plane_doubt(const std::array<Vec3, 3>& corners, const FaceNormal& normal,
                       const Vec3& error);

// Whether the face is thinner than the errors of its corners.
bool is_thin(const std::array<Vec3, 3>& corners, const Vec3& error);

}  // namespace rholm
