// Rotated coefficients: R = Rz(a - 90) J^-1 Rz(b) J Rz(c + 90), for each degree.
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "harmonic/motion/rotation_quarter.h"
#include "rholm/rotate.h"

namespace rholm {
namespace {

using Phases = std::vector<std::complex<double>>;

// Number of degrees in one task, which share memory. Chosen: 1/8 of a millisecond at L = 64.
constexpr std::size_t kDegreesPerTask = 8;

// Returns e^{i m angle}, m = 0 ... L.
Phases phases(int degree, double angle) {
  Phases result(static_cast<std::size_t>(degree) + 1);
  for (int m = 0; m <= degree; ++m) result[m] = {std::cos(m * angle), std::sin(m * angle)};
  return result;
}

// Applies Rz(angle), which multiplies C + i S by e^{i m angle}.
void turn_about_z(const Phases& phase, int l, double* c, double* s) {
  for (int m = 1; m <= l; ++m) {
    const double x = c[m], y = s[m];
    c[m] = phase[m].real() * x - phase[m].imag() * y;
    s[m] = phase[m].imag() * x + phase[m].real() * y;
  }
}

// Appends to `method` what was done to the coefficients, but not twice in a row.
void add_note(std::string& method, const std::string& note) {
  constexpr std::size_t kMaxLength = 256;  // bytes of a text in a model file
  if (method.empty() || method.ends_with(note) || method.size() + 2 + note.size() > kMaxLength) {
    return;
  }
  method += ", " + note;
}

}  // namespace

Coefficients rotate(const Coefficients& coefficients, const Rotation& rotation,
                    const Context& context) {
  const EulerAngles angles = euler_angles_of(rotation);
  const int degree = coefficients.degree();
  Coefficients result = coefficients;
  const bool about_z = rotation.x == 0 && rotation.y == 0;
  const double quarter = std::numbers::pi / 2;
  const Phases first =
      phases(degree, about_z ? angles.alpha + angles.gamma : angles.gamma + quarter);
  const Phases second = phases(degree, angles.beta), third = phases(degree, angles.alpha - quarter);
  const auto body = [&](std::size_t begin, std::size_t end) {
    QuarterTurn turn;
    for (std::size_t at = begin; at < end; ++at) {
      const int l = degree - static_cast<int>(at);  // the highest degree first
      double *c = &result.c(l, 0), *s = &result.s(l, 0);
      turn_about_z(first, l, c, s);
      if (about_z) continue;
      turn.set_degree(l);
      turn.apply(QuarterTurn::Way::kForward, c, s);
      turn_about_z(second, l, c, s);
      turn.apply(QuarterTurn::Way::kInverse, c, s);
      turn_about_z(third, l, c, s);
    }
  };
  parallel_for(static_cast<std::size_t>(degree) + 1, kDegreesPerTask, context, {"rotate"}, body);
  return result;
}

Expansion rotate(const Expansion& expansion, const Rotation& rotation, const Vec3& about,
                 const Context& context) {
  Expansion result = expansion;
  result.coefficients = rotate(expansion.coefficients, rotation, context);
  result.center = about + rotate(expansion.center - about, rotation);
  add_note(result.method, "rotated");
  if (result.errors) result.errors->diagonal = 0;
  return result;
}

// z -> -z: Pt_lm(-x) = (-1)^{l+m} Pt_lm(x); y -> -y: phi -> -phi; x -> -x: phi -> pi - phi.
Coefficients mirror(const Coefficients& coefficients, Axis axis) {
  Coefficients result = coefficients;
  for (int l = 0; l <= result.degree(); ++l) {
    for (int m = 0; m <= l; ++m) {
      const bool odd = (axis == Axis::kZ ? l + m : axis == Axis::kX ? m : 0) % 2 == 1;
      const bool odd_sine = axis == Axis::kZ ? odd : !odd;
      if (odd) result.c(l, m) = -result.c(l, m) + 0.0;  // Adding 0 turns -0 into 0.
      if (odd_sine && m > 0) result.s(l, m) = -result.s(l, m) + 0.0;
    }
  }
  return result;
}

Expansion mirror(const Expansion& expansion, Axis axis, const Vec3& about) {
  Expansion result = expansion;
  result.coefficients = mirror(expansion.coefficients, axis);
  add_note(result.method, "mirrored");
  Vec3& center = result.center;
  if (axis == Axis::kX) center.x = 2 * about.x - center.x;
  if (axis == Axis::kY) center.y = 2 * about.y - center.y;
  if (axis == Axis::kZ) center.z = 2 * about.z - center.z;
  return result;
}

}  // namespace rholm
