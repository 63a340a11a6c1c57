// Coefficients of a real function on the sphere. Layer: harmonic.
//
// Inside the library all coefficients are those of the real orthonormal harmonics without
// Condon-Shortley phase (method 1):
//   f(u) = sum_{l=0}^{L} sum_{m=0}^{l} [ C_lm cos(m phi) + S_lm sin(m phi) ] N_m P_lm(cos theta),
// with N_m P_lm such that the square of each term's function integrates to 1 over the sphere.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rholm/fields.h"
#include "rholm/vec3.h"

namespace rholm {

inline constexpr int kMaxDegree = 16384;  // 4 GiB of coefficients: chosen as the sanity limit

// C_lm and S_lm of degrees 0 ... L.
class Coefficients {
 public:
  // A zero of degree 0.
  Coefficients() : Coefficients(0) {}
  // Zeros up to degree L >= 0. Throws InvalidInput for L < 0 or L > kMaxDegree.
  explicit Coefficients(int degree);

  int degree() const { return degree_; }  // L
  // C_lm and S_lm, 0 <= m <= l <= degree(); not checked. S_l0 exists and is zero.
  double& c(int l, int m) { return values_[index(l, m)]; }
  double c(int l, int m) const { return values_[index(l, m)]; }
  double& s(int l, int m) { return values_[plane() + index(l, m)]; }
  double s(int l, int m) const { return values_[plane() + index(l, m)]; }
  // The array [2][L+1][L+1], row-major: cosine plane, sine plane; zeros for m > l.
  std::span<const double> values() const { return values_; }
  std::span<double> values() { return values_; }

  // A copy with degree L: cut off or filled with zeros.
  Coefficients resized(int degree) const;

 private:
  std::size_t plane() const { return (degree_ + std::size_t{1}) * (degree_ + std::size_t{1}); }
  std::size_t index(int l, int m) const {
    return static_cast<std::size_t>(l) * (degree_ + std::size_t{1}) + m;
  }
  int degree_ = 0;
  std::vector<double> values_;
};

// What the function is in terms of the surface x = center + r(u) u.
enum class RadialFunction {
  kRadius,  // r
  kGauge,   // q = 1/r
  kOther    // no surface at all: a gravity field, a temperature
};
EnumNames names_of(RadialFunction function);  // "radius", "gauge", "other"

// How far the surface of an expansion is from the shape it was made of, in the unit of lengths;
// empty where it is not known. Radial errors are |r - r_L| along directions from the centre,
// distances those of closest points, within 1 % (rms) and 3 % (largest); to first order, radial
// error times cos gamma, for meshes of more than two million faces (method 5).
struct TruncationErrors {
  std::optional<double> rms;  // radial, over solid angle
  bool rms_is_exact = false;  // by Parseval (M7), not measured
  // Radial and as a distance, at the vertices, in closed form (method 5), where edges are long
  // against 1/L.
  std::optional<double> predicted_max, predicted_max_distance;
  // Radial and as a distance, at `points` points of the shape: its vertices, and more where faces
  // are long against 1/L.
  std::optional<double> measured_max, measured_max_distance;
  // No radial error is larger, by branch and bound (method 5); within 1 % of measured_max where
  // that takes few evaluations. Empty for a gauge, or beyond the diagonal.
  std::optional<double> max_bound;
  std::optional<double> distance_rms;  // over area, the larger of both ways
  bool distances_are_closest = false;  // by closest points, not to first order
  std::size_t points = 0;              // at which was measured
  double diagonal = 0;                 // of the shape's bounding box; 0 if unknown
};

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<TruncationErrors>, const Visitor& field) {
  using T = TruncationErrors;
  field(&T::rms, {.name = "rms", .help = "radial, root mean square over solid angle"});
  field(&T::rms_is_exact,
        {.name = "rms_is_exact", .help = "whether rms is by Parseval's identity, not measured"});
  field(&T::predicted_max,
        {.name = "predicted_max", .help = "largest radial error at the vertices, in closed form"});
  field(&T::predicted_max_distance,
        {.name = "predicted_max_distance", .help = "the same as a distance"});
  field(&T::measured_max,
        {.name = "measured_max", .help = "largest radial error at `points` points of the shape"});
  field(&T::max_bound, {.name = "max_bound",
                        .help = "no radial error is larger, by branch and bound; None for a gauge, "
                                "or beyond the diagonal"});
  field(&T::measured_max_distance,
        {.name = "measured_max_distance", .help = "the same as a distance"});
  field(&T::distance_rms,
        {.name = "distance_rms",
         .help = "root mean square of distances over area, the larger of both ways"});
  field(&T::distances_are_closest,
        {.name = "distances_are_closest", .help = "whether distances are by closest points"});
  field(&T::points, {.name = "points", .help = "at which was measured"});
  field(&T::diagonal, {.name = "diagonal", .help = "of the shape's bounding box; 0 if not known"});
}

// What the coefficients of a gravity field are relative to.
struct GravityField {
  double gravity_constant = 0;  // G M in m^3/s^2; finite and above 0
  double reference_radius = 0;  // of the sphere about the centre, in m; finite and above 0
  friend bool operator==(const GravityField&, const GravityField&) = default;  // equal numbers
};

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<GravityField>, const Visitor& field) {
  using G = GravityField;
  field(&G::gravity_constant, {.name = "gravity_constant", .help = "G M in m^3/s^2"});
  field(&G::reference_radius,
        {.name = "reference_radius", .help = "of the sphere about the centre, in m"});
}

// A surface as coefficients: what a model file holds.
struct Expansion {
  Coefficients coefficients = {};  // in the unit of lengths; of a gauge in 1/unit
  RadialFunction function = RadialFunction::kRadius;  // which function of directions it is
  Vec3 center = {};       // of the expansion, in the coordinates of the original shape
  std::string unit = {};  // of lengths, free text; empty if unknown
  // How the coefficients were found: "edge", "area", ...; empty if unknown.
  std::string method = {};
  // int f^2 dOmega of the expanded function itself, not only of its first degrees: by Parseval
  // ||f - f_L||^2 = norm_squared - sum |c_lm|^2, (M7).
  std::optional<double> norm_squared = {};
  // S of the predicted tail E_l ~ S / (pi l^4), method 5.
  std::optional<double> tail_strength = {};
  // Of all its degrees; they do not hold when it is cut off.
  std::optional<TruncationErrors> errors = {};
  // Made of a surface that is not star-shaped: the function is the signed sum of the radii along
  // each direction, and the volume and the area of its graph are not those of the body.
  bool signed_sum = false;
  // Of a gravity field (kOther); empty if unknown, and for all others.
  std::optional<GravityField> gravity = {};
  // Relative error that the coefficients were computed with: of c_00, and in l2 of all others
  // together. The wanted one, or if it was not reached the estimated one; of random points three
  // deviations. Empty if unknown.
  std::optional<double> precision = {};
};

// Throws Unsupported for coefficients that are said not to be of a surface (kOther); looks at no
// number, so that the radius may still be negative somewhere.
void require_surface(const Expansion& expansion);

// Throws Unsupported for a signed sum, whose graph is not the surface of the body: `what` names
// what is asked for ("the volume").
void require_star_shaped(const Expansion& expansion, const std::string& what);

// Throws InvalidInput for a gravity field whose numbers are not finite and above 0, or whose
// function is not kOther; `name` begins the message. An expansion without one is let pass.
void check_gravity(const Expansion& expansion, const std::string& name);

// How numbers of a file are scaled: what the mean square of each harmonic over the sphere is.
enum class Normalization {
  kOrthonormal,  // 1/(4 pi), so that its square integrates to 1
  kFourPi,       // 1
  kSchmidt       // 1/(2l+1): semi-normalised
};
EnumNames names_of(Normalization normalization);  // "orthonormal", "4pi", "schmidt"

// What the numbers of a file multiply. The default is that of SHTOOLS.
struct Convention {
  Normalization normalization = Normalization::kFourPi;  // of the harmonics
  int csphase = 1;  // 1: without Condon-Shortley phase, -1: with the factor (-1)^m
  // Whether the same function has the same numbers in both.
  friend bool operator==(const Convention&, const Convention&) = default;
};

// Its list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<Convention>, const Visitor& field) {
  using C = Convention;
  field(&C::normalization, {.name = "normalization", .help = "how the functions are scaled"});
  field(&C::csphase, {.name = "csphase",
                      .help = "1: without Condon-Shortley phase; -1: with it",
                      .value = "1|-1",
                      .least = -1,
                      .most = 1});
}

// Coefficients as numbers of another convention, and back. Both throw InvalidInput for a csphase
// other than 1 or -1.
Coefficients to_convention(const Coefficients& internal, const Convention& convention);
Coefficients from_convention(const Coefficients& external, const Convention& convention);

// Energy per degree, l = 0 ... L: sum over m of C_lm^2 + S_lm^2. Its sum over l is int f_L^2
// dOmega.
std::vector<double> power_spectrum(const Coefficients& coefficients);

}  // namespace rholm
