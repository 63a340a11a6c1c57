// Rotations and mirror images of functions on the sphere and of expansions. Layer: harmonic.
//
// A rotation R moves the point x to R x, and the function f becomes f(R^-1 u): the surface turns as
// a whole. Angles are radians, counter-clockwise seen from the tip of the axis. The energy per
// degree (power_spectrum()) does not change.
#pragma once

#include <array>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// A unit quaternion: cos(a/2), sin(a/2) times the axis. Its negative is the same rotation.
struct Rotation {
  double w = 1;                // cos(a/2)
  double x = 0, y = 0, z = 0;  // sin(a/2) times the axis
};

// A rotation by an angle about an axis.
struct AxisAngle {
  Vec3 axis = {0, 0, 1};  // unit vector
  double angle = 0;       // 0 ... pi
};

// Rz(alpha) Ry(beta) Rz(gamma): about fixed axes, first by gamma about z.
struct EulerAngles {
  double alpha = 0;  // about z, last
  double beta = 0;   // about y, 0 ... pi
  double gamma = 0;  // about z, first
};

// Rows of an orthogonal matrix: (R x)_i = rows[i] . x.
using RotationMatrix = std::array<Vec3, 3>;

// Return the rotation. Throw InvalidInput for numbers that are not finite. The axis has any length
// but 0. R R^T must be within 1e-4 of 1; a mirror image (determinant -1) is refused.
Rotation rotation_about(const Vec3& axis, double angle);
Rotation rotation_of(const EulerAngles& angles);
Rotation rotation_of(const RotationMatrix& matrix);

// Convert a rotation. For an angle of 0 the axis is z. For beta = 0 or pi only the sum or
// difference of alpha and gamma matters: each is given half of it.
AxisAngle axis_angle_of(const Rotation& rotation);
EulerAngles euler_angles_of(const Rotation& rotation);
RotationMatrix matrix_of(const Rotation& rotation);

// Returns the rotation that applies `first`, then `second`.
Rotation compose(const Rotation& second, const Rotation& first);
// Returns the inverse rotation.
Rotation inverse(const Rotation& rotation);
// Returns the angle of the rotation that takes one to the other, 0 ... pi.
double angle_between(const Rotation& a, const Rotation& b);

// Returns the point R x.
Vec3 rotate(const Vec3& x, const Rotation& rotation);

// Rotates a function. O(L^3); errors are some hundred rounding units of the norm at degree 512.
// Throws Cancelled, InvalidInput for a zero or not finite quaternion; others are normalised.
Coefficients rotate(const Coefficients& coefficients, const Rotation& rotation,
                    const Context& context = {});

// Rotates a surface about the point `about`, so that its centre moves too. Errors are kept, except
// the diagonal of the bounding box, which changes.
Expansion rotate(const Expansion& expansion, const Rotation& rotation, const Vec3& about = {},
                 const Context& context = {});

// A coordinate axis.
enum class Axis {
  kX,  // (1, 0, 0)
  kY,  // (0, 1, 0)
  kZ   // (0, 0, 1)
};
// Return the mirror image in the plane through `about` across an axis: kX negates x.
Coefficients mirror(const Coefficients& coefficients, Axis axis);
Expansion mirror(const Expansion& expansion, Axis axis, const Vec3& about = {});

}  // namespace rholm
