// Rotations that turn one function on the sphere onto another. Layer: harmonic.
//
// align() finds the rotation with the largest correlation, equivalently the smallest distance
//   |R a - b|^2 = |a|^2 + |b|^2 - 2 <R a, b>,
// computed from coefficients by Parseval's identity. Degree 0 does not turn, so it counts in the
// distance only. Functions are compared as given: the same body about another centre is another
// function. align() of expansions takes the centres into account.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/rotate.h"

namespace rholm {

// Principal axes of the quadratic form u^T Q u of the degree-2 coefficients, longest axis first.
// For a radius they are the axes of its ellipsoid-like part. They depend on the centre and on
// degree 2 only; the axes of inertia from inertia() are near them but not the same.
struct PrincipalAxes {
  std::array<Vec3, 3> axes;      // right-handed, orthonormal
  std::array<double, 3> values;  // values of the form along the axes, descending; their sum is 0
  Rotation to_axes;              // turns axes[0] to x, axes[1] to y, axes[2] to z
  // Axes about which the form can turn without changing. There are none, or the one axis of
  // revolution, or three if the form has no direction at all (a sphere, a cube).
  std::vector<Vec3> free_axes = {};
};
// Computes the axes. Each axis points to the larger part of degree 3; where that part vanishes, the
// sign is arbitrary. Values that differ by less than 1e-10 of the mean (c_00) count as equal. Then
// to_axes is the smallest sufficient rotation, the identity for three equal values. For a gauge,
// 1/r, the sign of the form is reversed.
PrincipalAxes principal_axes(const Coefficients& coefficients,
                             RadialFunction function = RadialFunction::kRadius);

// Starting points of the search for a rotation.
enum class AlignStart {
  kCorrelation,   // all rotations, by Fourier transforms over SO(3)
  kPrincipalAxes  // the four ways to map axes to axes: faster, wrong if two are nearly equal
};

EnumNames names_of(AlignStart start);  // "correlation", "principal-axes"

// Options of the search, and limits below which correlations count as equal.
struct AlignOptions {
  AlignStart start = AlignStart::kCorrelation;  // where the search starts
  int bandwidth = 20;  // degrees used by the search, 1 ... 64; its grid has steps of about 6 deg
  int refine_degree = 64;  // degrees used by Newton's iteration
  // Another rotation is reported if its correlation (-1 ... 1) is at most this below the best one.
  double margin = 0.01;
  bool mirror = false;  // true: also try the mirror image of a (x -> -x, then rotated)
  // Root mean square over the sphere of the unknown part of a and b. A function that is constant up
  // to this, or up to 1e-10 of its mean, gets three free axes and no rotation.
  double unknown_a = 0, unknown_b = 0;
};

// Lists the fields of AlignOptions (fields.h).
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

// A rotation of a, and how closely it brings a to b.
struct AlignedRotation {
  Rotation rotation;       // rotation of the mirror image, if mirrored
  bool mirrored = false;   // true if the reflection x -> -x comes first; y and z stay
  double correlation = 0;  // of degrees 1 ... refine_degree; 1: equal up to a factor
  double distance = 0;     // root mean square of R a - b over the sphere, all degrees
};

// Lists the fields of AlignedRotation.
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

// The best rotation, and the rotations that are nearly as good.
struct Alignment {
  AlignedRotation best;  // among equal ones (to rounding) the smallest turn, not mirrored
  // Other rotations that are nearly as good, best first: symmetries of the shape. At most 32.
  std::vector<AlignedRotation> ambiguities;
  // Axes in the frame of b about which a turn by one radian changes the correlation by less than
  // the margin, to second order. A surface of revolution has one, a sphere three.
  std::vector<Vec3> free_axes;
  double unaligned_distance = 0;  // distance before any rotation
};

// Lists the fields of Alignment.
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

// Finds the rotation that turns a onto b. Throws InvalidInput for options out of range or
// coefficients that are not finite; Cancelled.
Alignment align(const Coefficients& a, const Coefficients& b, const AlignOptions& options = {},
                const Context& context = {});

// The points of two surfaces that are brought together before the rotation.
enum class AlignCenters {
  kAuto,    // kVolume if both surfaces can be seen from their centroids, otherwise kOwn
  kVolume,  // centroids of the solids: they move with the shape and hardly depend on noise
  kOwn      // the centres of the expansions
};
EnumNames names_of(AlignCenters centers);  // "auto", "volume", "own"

// Rigid motion of a point p to R (p - from) + to. If mirrored, to R M (p - from) + to with M =
// diag(-1, 1, 1): the reflection in the plane through `from` across the x axis.
struct Placement {
  Alignment alignment;                           // R and whether it is mirrored
  Vec3 from, to;                                 // points of a and of b brought together
  AlignCenters centers = AlignCenters::kVolume;  // which points these are: kVolume or kOwn
  std::string why_own = {};  // if kAuto chose kOwn: why a surface cannot be seen from its centroid
};

// Aligns two surfaces. With kVolume both are first expanded about their centroids, up to degree
// 256, by recentered(), which may throw NotStarShaped. Truncation errors stated in the expansions
// count as unknown parts. Throws InvalidInput if the functions of a and b differ.
Placement align(const Expansion& a, const Expansion& b, AlignCenters centers,
                const AlignOptions& options = {}, const Context& context = {});

// Returns the expansion a moved by the placement.
Expansion placed(const Expansion& a, const Placement& placement, const Context& context = {});

// Returns the root mean square of a - b over the sphere, by Parseval; missing degrees are zero.
double distance(const Coefficients& a, const Coefficients& b);

// Returns the distance of the rotation-invariant descriptors of Kazhdan, Funkhouser and
// Rusinkiewicz (2003), roots of power_spectrum(): a lower bound of the distance after any rotation.
double descriptor_distance(const Coefficients& a, const Coefficients& b);

}  // namespace rholm
