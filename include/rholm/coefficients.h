// Coefficients of a real function on the sphere. Layer: harmonic.
//
// All coefficients inside the library refer to the real orthonormal harmonics without
// Condon-Shortley phase (method 1). The function is
//   f(u) = sum_{l=0}^{L} sum_{m=0}^{l} [ C_lm cos(m phi) + S_lm sin(m phi) ] N_m P_lm(cos theta).
// Here N_m scales P_lm so that the square of each basis function integrates to 1 over the sphere.
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

// Coefficients C_lm and S_lm of degrees 0 ... L.
class Coefficients {
 public:
  // The zero function of degree 0.
  Coefficients() : Coefficients(0) {}
  // Zeros up to degree L >= 0. Throws InvalidInput for L < 0 or L > kMaxDegree.
  explicit Coefficients(int degree);

  int degree() const { return degree_; }  // L
  // Access C_lm and S_lm, 0 <= m <= l <= degree(); not checked. S_l0 exists and is zero.
  double& c(int l, int m) { return values_[index(l, m)]; }
  double c(int l, int m) const { return values_[index(l, m)]; }
  double& s(int l, int m) { return values_[plane() + index(l, m)]; }
  double s(int l, int m) const { return values_[plane() + index(l, m)]; }
  // Return the array [2][L+1][L+1], row-major: cosine plane, sine plane; zeros for m > l.
  std::span<const double> values() const { return values_; }
  std::span<double> values() { return values_; }

  // Returns a copy with degree L: truncated, or padded with zeros.
  Coefficients resized(int degree) const;

 private:
  std::size_t plane() const { return (degree_ + std::size_t{1}) * (degree_ + std::size_t{1}); }
  std::size_t index(int l, int m) const {
    return static_cast<std::size_t>(l) * (degree_ + std::size_t{1}) + m;
  }
  int degree_ = 0;
  std::vector<double> values_;
};

// Meaning of the function for the surface x = center + r(u) u.
enum class RadialFunction {
  kRadius,  // r
  kGauge,   // q = 1/r
  kOther    // no surface: a gravity field, a temperature
};
EnumNames names_of(RadialFunction function);  // "radius", "gauge", "other"

// Distance between the surface of an expansion and the original shape, in the unit of lengths;
// empty if unknown. Radial errors are |r - r_L| along directions from the centre. Distances are to
// closest points, within 1 % (rms) and 3 % (largest). For meshes of more than two million faces
// they are to first order: radial error times cos gamma (method 5).
struct TruncationErrors {
  std::optional<double> rms;  // radial, over solid angle
  bool rms_is_exact = false;  // true if by Parseval (M7), false if measured
  // Radial error and distance at the vertices, in closed form (method 5). Given where edges are
  // long compared with 1/L.
  std::optional<double> predicted_max, predicted_max_distance;
  // Radial error and distance measured at `points` points of the shape: its vertices, and more
  // points where faces are long compared with 1/L.
  std::optional<double> measured_max, measured_max_distance;
  // Upper bound of the radial error, by branch and bound (method 5); within 1 % of measured_max if
  // that needs few evaluations. Empty for a gauge, or if above the diagonal.
  std::optional<double> max_bound;
  std::optional<double> distance_rms;  // root mean square over area, the larger of both directions
  bool distances_are_closest = false;  // true if by closest points, false if to first order
  std::size_t points = 0;              // number of points of the measurement
  double diagonal = 0;                 // diagonal of the shape's bounding box; 0 if unknown
};

// Lists the fields of TruncationErrors.
template <typename Visitor>
void visit_fields(FieldsOf<TruncationErrors>, const Visitor& field) {
  using T = TruncationErrors;
  field(&T::rms, {.name = "rms", .help = "root mean square radial error over solid angle"});
  field(&T::rms_is_exact,
        {.name = "rms_is_exact",
         .help = "true if rms is exact by Parseval's identity, false if it is measured"});
  field(&T::predicted_max,
        {.name = "predicted_max",
         .help = "largest radial error at the vertices, predicted in closed form"});
  field(
      &T::predicted_max_distance,
      {.name = "predicted_max_distance",
       .help = "largest distance between the surfaces at the vertices, predicted in closed form"});
  field(&T::measured_max,
        {.name = "measured_max",
         .help = "largest radial error measured at `points` points of the shape"});
  field(&T::max_bound, {.name = "max_bound",
                        .help = "upper bound of the radial error, by branch and bound; None for a "
                                "gauge, or if larger than the diagonal"});
  field(
      &T::measured_max_distance,
      {.name = "measured_max_distance",
       .help = "largest distance between the surfaces, measured at `points` points of the shape"});
  field(&T::distance_rms, {.name = "distance_rms",
                           .help = "root mean square distance between the surfaces over area, the "
                                   "larger of both directions"});
  field(
      &T::distances_are_closest,
      {.name = "distances_are_closest",
       .help = "true if distances are to closest points, false if they are first-order estimates"});
  field(&T::points,
        {.name = "points", .help = "number of points of the shape at which errors are measured"});
  field(&T::diagonal,
        {.name = "diagonal", .help = "diagonal of the shape's bounding box; 0 if unknown"});
}

// Reference values of the coefficients of a gravity field.
struct GravityField {
  double gravity_constant = 0;  // G M in m^3/s^2; finite and above 0
  double reference_radius = 0;  // radius of the sphere about the centre, in m; finite and above 0
  friend bool operator==(const GravityField&, const GravityField&) = default;  // equal numbers
};

// Lists the fields of GravityField.
template <typename Visitor>
void visit_fields(FieldsOf<GravityField>, const Visitor& field) {
  using G = GravityField;
  field(&G::gravity_constant,
        {.name = "gravity_constant", .help = "gravity constant G M, in m^3/s^2"});
  field(&G::reference_radius, {.name = "reference_radius",
                               .help = "radius of the reference sphere about the centre, in m"});
}

// A surface as coefficients: the content of a model file.
struct Expansion {
  Coefficients coefficients = {};  // coefficients in the unit of lengths; for a gauge in 1/unit
  RadialFunction function = RadialFunction::kRadius;  // meaning of the function
  Vec3 center = {};       // centre of the expansion, in the coordinates of the shape
  std::string unit = {};  // unit of lengths, free text; empty if unknown
  // Method that computed the coefficients: "edge", "area", ...; empty if unknown.
  std::string method = {};
  // int f^2 dOmega of the expanded function with all its degrees. By Parseval ||f - f_L||^2 =
  // norm_squared - sum |c_lm|^2, (M7).
  std::optional<double> norm_squared = {};
  // S of the predicted tail E_l ~ S / (pi l^4), method 5.
  std::optional<double> tail_strength = {};
  // Errors of the expansion with all its degrees; a truncated expansion has others.
  std::optional<TruncationErrors> errors = {};
  // True if the surface is not star-shaped: the function is the signed sum of the radii along each
  // direction. Volume and area of its graph differ from the body's.
  bool signed_sum = false;
  // Set for a gravity field (kOther) with known reference values; empty for all others.
  std::optional<GravityField> gravity = {};
  // Relative error of the coefficients: of c_00, and l2 of all others together. It is the wanted
  // error, or the estimated error where the wanted one was not reached. For Monte Carlo it is three
  // deviations. Empty if unknown.
  std::optional<double> precision = {};
};

// Throws Unsupported if the coefficients are declared not to be a surface (kOther). Checks no
// number: the radius may still be negative somewhere.
void require_surface(const Expansion& expansion);

// Throws Unsupported for a signed sum, whose graph is not the surface of the body. `what` names the
// requested quantity for the message ("the volume").
void require_star_shaped(const Expansion& expansion, const std::string& what);

// Throws InvalidInput for a gravity field whose numbers are not finite and above 0, or whose
// function is not kOther. Does nothing without one. `name` begins the message.
void check_gravity(const Expansion& expansion, const std::string& name);

// Scaling of the numbers of a file: the mean square of each harmonic over the sphere.
enum class Normalization {
  kOrthonormal,  // 1/(4 pi), so that its square integrates to 1
  kFourPi,       // 1
  kSchmidt       // 1/(2l+1): semi-normalised
};
EnumNames names_of(Normalization normalization);  // "orthonormal", "4pi", "schmidt"

// Harmonics that the numbers of a file multiply. The default is SHTOOLS's convention.
struct Convention {
  Normalization normalization = Normalization::kFourPi;  // scaling of the harmonics
  int csphase = 1;  // 1: without Condon-Shortley phase, -1: with the factor (-1)^m
  // Returns true if the same function has the same numbers in both conventions.
  friend bool operator==(const Convention&, const Convention&) = default;
};

// Lists the fields of Convention (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<Convention>, const Visitor& field) {
  using C = Convention;
  field(&C::normalization,
        {.name = "normalization",
         .help = "normalization of the spherical harmonics that the numbers in a file multiply"});
  field(&C::csphase, {.name = "csphase",
                      .help = "sign of the harmonics; 1: without the Condon-Shortley phase; -1: "
                              "with the factor (-1)^m",
                      .value = "1|-1",
                      .least = -1,
                      .most = 1});
}

// Convert coefficients to the numbers of another convention, and back. Both throw InvalidInput for
// a csphase other than 1 or -1.
Coefficients to_convention(const Coefficients& internal, const Convention& convention);
Coefficients from_convention(const Coefficients& external, const Convention& convention);

// Returns the energy per degree, l = 0 ... L: sum over m of C_lm^2 + S_lm^2. Its sum over l is int
// f_L^2 dOmega.
std::vector<double> power_spectrum(const Coefficients& coefficients);

}  // namespace rholm
