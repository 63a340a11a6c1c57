// Rotations and mirror images of functions on the sphere and of expansions. Layer: harmonic.
//
// A rotation R moves the point x to R x; the function f becomes f(R^-1 u): a surface turns as a
// whole. Angles are radians, counter-clockwise seen from the tip of the axis. Energy per degree
// (power_spectrum()) is the same before and after.
#pragma once

#include <array>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// A unit quaternion: cos(a/2), sin(a/2) times the axis. The same rotation as its negative.
struct Rotation {
  double w = 1;                // cos(a/2)
  double x = 0, y = 0, z = 0;  // sin(a/2) times the axis
};

// A turn by an angle about an axis.
struct AxisAngle {
  Vec3 axis = {0, 0, 1};  // unit vector
  double angle = 0;       // 0 ... pi
};

// Rz(alpha) Ry(beta) Rz(gamma): by gamma about z first, about the fixed axes.
struct EulerAngles {
  double alpha = 0;  // about z, last
  double beta = 0;   // about y, 0 ... pi
  double gamma = 0;  // about z, first
};

// Rows of an orthogonal matrix: (R x)_i = rows[i] . x.
using RotationMatrix = std::array<Vec3, 3>;

// Each throws InvalidInput for numbers that are not finite. The axis has any length but 0. The
// matrix may be rounded, R R^T within 1e-4 of 1; a mirror image (determinant -1) is refused.
Rotation rotation_about(const Vec3& axis, double angle);
Rotation rotation_of(const EulerAngles& angles);
Rotation rotation_of(const RotationMatrix& matrix);

// The same rotation in other words. For an angle of 0 the axis is z. For beta = 0 or pi, where only
// alpha + gamma or alpha - gamma counts, both are given half of it.
AxisAngle axis_angle_of(const Rotation& rotation);
EulerAngles euler_angles_of(const Rotation& rotation);
RotationMatrix matrix_of(const Rotation& rotation);

// `second` after `first`.
Rotation compose(const Rotation& second, const Rotation& first);
// Back again.
Rotation inverse(const Rotation& rotation);
// The angle of the rotation that takes one to the other, 0 ... pi.
double angle_between(const Rotation& a, const Rotation& b);

// The point R x.
Vec3 rotate(const Vec3& x, const Rotation& rotation);

// O(L^3), errors a few hundred rounding units of the norm at degree 512. Throws Cancelled,
// InvalidInput for a quaternion that is zero or not finite; other lengths than 1 are normalised.
Coefficients rotate(const Coefficients& coefficients, const Rotation& rotation,
                    const Context& context = {});

// The surface turned about the point `about`: its centre moves too. What is known of its errors
// stays, but for the diagonal of the bounding box, which is another one.
Expansion rotate(const Expansion& expansion, const Rotation& rotation, const Vec3& about = {},
                 const Context& context = {});

// A coordinate axis.
enum class Axis {
  kX,  // (1, 0, 0)
  kY,  // (0, 1, 0)
  kZ   // (0, 0, 1)
};
// The mirror image in the plane through `about` across an axis: kX changes the sign of x.
Coefficients mirror(const Coefficients& coefficients, Axis axis);
Expansion mirror(const Expansion& expansion, Axis axis, const Vec3& about = {});

}  // namespace rholm
