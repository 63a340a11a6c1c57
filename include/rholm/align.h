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
#include "rholm/fields.h"
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

EnumNames names_of(AlignStart start);  // "correlation", "principal-axes"

// How the rotation is sought, and what counts as equal.
struct AlignOptions {
  AlignStart start = AlignStart::kCorrelation;  // of the search
  int bandwidth = 20;  // degrees used by the search, 1 ... 64; its grid has steps of about 6 deg
  int refine_degree = 64;  // degrees used by Newton's iteration
  // Other rotations are reported if their correlation (-1 ... 1) is at most this below the best.
  double margin = 0.01;
  bool mirror = false;  // also try the mirror image of a (x -> -x, then rotated)
  // Root mean square over the sphere of what is not known of a and b. A function that is constant
  // but for this, or for 1e-10 of its mean, has nothing to turn: three free axes, no rotation.
  double unknown_a = 0, unknown_b = 0;
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<AlignOptions>, const Visitor& field) {
  using O = AlignOptions;
  field(&O::start,
        {.name = "start",
         .help =
             "where the search begins: correlation, over all rotations; principal-axes, the four "
             "ways to lay principal axes on principal axes, faster and blind where two are equal"});
  field(&O::bandwidth, {.name = "bandwidth",
                        .help = "degrees used by the search over all rotations",
                        .value = "L",
                        .least = 1,
                        .most = 64});
  field(&O::refine_degree, {.name = "refine_degree",
                            .help = "degrees used by the iteration that refines what was found",
                            .value = "L",
                            .least = 1,
                            .most = kMaxDegree});
  field(&O::margin,
        {.name = "margin",
         .help = "report other rotations with a correlation at most this below the best",
         .value = "C",
         .least = 0,
         .most = 2});
  field(&O::mirror, {.name = "mirror",
                     .help = "try the mirror image of A, too: reflected in the plane through its "
                             "centre, across the x axis, before it is turned"});
  field(&O::unknown_a, {.name = "unknown_a",
                        .help = "root mean square over the sphere of what is not known of A",
                        .least = 0,
                        .in_program = false});
  field(&O::unknown_b, {.name = "unknown_b",
                        .help = "root mean square over the sphere of what is not known of B",
                        .least = 0,
                        .in_program = false});
}

// A rotation of a, and how well it lays a on b.
struct AlignedRotation {
  Rotation rotation;       // of the mirror image, if mirrored
  bool mirrored = false;   // the reflection x -> -x comes first; y and z stay
  double correlation = 0;  // of degrees 1 ... refine_degree, normalised: 1 is equal up to a factor
  double distance = 0;     // root mean square of R a - b over the sphere, all degrees
};

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<AlignedRotation>, const Visitor& field) {
  using A = AlignedRotation;
  field(&A::rotation, {.name = "rotation", .help = "of the mirror image, if mirrored"});
  field(&A::mirrored,
        {.name = "mirrored", .help = "whether the reflection x -> -x comes first; y and z stay"});
  field(&A::correlation, {.name = "correlation",
                          .help = "of degrees from 1 on, normalised: 1 is equal up to a factor"});
  field(&A::distance,
        {.name = "distance", .help = "root mean square of R a - b over the sphere, all degrees"});
}

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

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<Alignment>, const Visitor& field) {
  using A = Alignment;
  field(&A::best, {.name = "best", .help = "of several that are equal the smallest turn"});
  field(
      &A::ambiguities,
      {.name = "ambiguities",
       .help = "others that are nearly as good, best first, at most 32: symmetries of the shape"});
  field(&A::free_axes,
        {.name = "free_axes",
         .help = "axes in the frame of b about which turning changes nothing, (n, 3)"});
  field(&A::unaligned_distance, {.name = "unaligned_distance", .help = "before any rotation"});
}

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
EnumNames names_of(AlignCenters centers);  // "auto", "volume", "own"

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
