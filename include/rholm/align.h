// Turning one function on the sphere onto another. Layer: harmonic.
//
// The rotation sought has the largest correlation, equivalently the smallest distance
//   |R a - b|^2 = |a|^2 + |b|^2 - 2 <R a, b>,
// all by Parseval's identity from coefficients. Degree 0 does not turn and is in the distance only.
// Functions are compared as they are; the same body seen from another point is another function.
// For surfaces, align() of expansions sees to that.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/rotate.h"

namespace rholm {

// The axes of the quadratic form u^T Q u that the coefficients of degree 2 are: of a radius those
// of its ellipsoid-like part, longest first. They depend on the centre of the expansion, and on no
// other degree: the axes of inertia of the solid, of inertia(), are near them but not the same.
struct PrincipalAxes {
  std::array<Vec3, 3> axes;      // right-handed, orthonormal
  std::array<double, 3> values;  // of the form, descending; their sum is 0
  Rotation to_axes;              // turns axes[0] to x, axes[1] to y, axes[2] to z
  // About these the form turns freely: none, the one axis of revolution, or three where it has no
  // direction at all (a sphere, a cube).
  std::vector<Vec3> free_axes = {};
};
// Of the two signs of each axis that which points to the larger part of degree 3; where that
// vanishes they are arbitrary. Values that differ by less than 1e-10 of the mean (c_00) are equal:
// then to_axes is the smallest turn that will do, none for three of them. For a gauge, 1/r, the
// form's sign is turned.
PrincipalAxes principal_axes(const Coefficients& coefficients,
                             RadialFunction function = RadialFunction::kRadius);

// Where the search for a rotation begins.
enum class AlignStart {
  kCorrelation,   // all rotations, by Fourier transforms over SO(3)
  kPrincipalAxes  // the four ways to lay axes on axes: faster, wrong where two are nearly equal
};

// How the rotation is sought, and what counts as equal.
struct AlignOptions {
  AlignStart start = AlignStart::kCorrelation;  // of the search
  int bandwidth = 20;  // degrees used by the search, 1 ... 64; its grid has steps of about 6 deg
  int refine_degree = 64;  // degrees used by Newton's iteration
  // Other rotations are reported if their correlation (-1 ... 1) is at most this below the best.
  double margin = 0.01;
  bool allow_mirror = false;  // also try the mirror image of a (x -> -x, then rotated)
  // Root mean square over the sphere of what is not known of a and b. A function that is constant
  // but for this, or for 1e-10 of its mean, has nothing to turn: three free axes, no rotation.
  double unknown_a = 0, unknown_b = 0;
};

// A rotation of a, and how well it lays a on b.
struct AlignedRotation {
  Rotation rotation;       // of the mirror image, if mirrored
  bool mirrored = false;   // the reflection x -> -x comes first; y and z stay
  double correlation = 0;  // of degrees 1 ... refine_degree, normalised: 1 is equal up to a factor
  double distance = 0;     // root mean square of R a - b over the sphere, all degrees
};

// The best rotation, and those that are nearly as good.
struct Alignment {
  AlignedRotation best;  // of several that are equal to rounding the smallest turn, no mirror image
  // Others that are nearly as good, best first: symmetries of the shape. At most 32.
  std::vector<AlignedRotation> ambiguities;
  // Axes in the frame of b about which turning by a radian changes the correlation by less than the
  // margin, to second order: a surface of revolution has one, a sphere three.
  std::vector<Vec3> free_axes;
  double unaligned_distance = 0;  // before any rotation
};

// Turns a onto b. Throws InvalidInput for options out of range or coefficients that are not finite;
// Cancelled.
Alignment align(const Coefficients& a, const Coefficients& b, const AlignOptions& options = {},
                const Context& context = {});

// Which points of two surfaces are laid on each other before they are turned.
enum class AlignCenters {
  kAuto,    // kVolume if both surfaces can be seen from their centroids, else kOwn
  kVolume,  // centroids of the solids: they move with the shape and hardly feel noise
  kOwn      // the centres of the expansions
};
const char* to_string(AlignCenters centers);                // "auto", "volume", "own"
AlignCenters parse_align_centers(const std::string& name);  // throws InvalidInput

// The point p becomes R (p - from) + to; mirrored, R M (p - from) + to, with M = diag(-1, 1, 1):
// the reflection in the plane through `from` across the x axis.
struct Placement {
  Alignment alignment;                           // R and whether it is mirrored
  Vec3 from, to;                                 // the points laid on each other, of a and of b
  AlignCenters centers = AlignCenters::kVolume;  // which points these are: kVolume or kOwn
  std::string why_own = {};  // of kAuto that took kOwn: why a surface cannot be seen so
};

// The same for surfaces; with kVolume as they are seen from there, up to degree 256 (recentered(),
// which also throws NotStarShaped). What their errors say is left out counts as not known. Throws
// InvalidInput if their functions differ.
Placement align(const Expansion& a, const Expansion& b, AlignCenters centers,
                const AlignOptions& options = {}, const Context& context = {});

// The expansion a moved as the placement says.
Expansion placed(const Expansion& a, const Placement& placement, const Context& context = {});

// Root mean square of a - b over the sphere, by Parseval's identity; missing degrees are zero.
double distance(const Coefficients& a, const Coefficients& b);

// Distance of the rotation-invariant descriptors of Kazhdan, Funkhouser and Rusinkiewicz (2003),
// the norms per degree (roots of power_spectrum()): at most the distance after any rotation.
double descriptor_distance(const Coefficients& a, const Coefficients& b);

}  // namespace rholm
