// Volume, area and centroid of the solid under a harmonic surface, on a Gauss-Legendre grid:
//   V = int r^3/3 dOmega,   V c = int r^4/4 u dOmega,   A = int r sqrt(r^2 + |grad_S r|^2) dOmega.
// With r of degree L the first two integrands are polynomials of degree 3L and 4L + 1, which the
// grid integrates exactly.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/compensated_sum.h"
#include "harmonic/coefficients/solid_gradient.h"
#include "rholm/error.h"
#include "rholm/harmonic.h"
#include "rholm/synthesize.h"

namespace rholm {
namespace {

// Rings beyond the 2L + 1 that make volume and centroid exact, for the area and for a gauge, whose
// integrands are not polynomials (chosen: an ellipsoid's area then converges to 1e-12).
constexpr int kMoreRings = 48;
constexpr std::size_t kRingsAtOnce = 64;  // chosen: bounds the memory at high degrees

struct Sums {
  CompensatedSum volume, area, x, y, z;

  void add(const Vec3& u, double value, const Vec3& gradient, bool gauge, double weight) {
    const double r = gauge ? 1 / value : value;
    // |grad_S r| = |grad_S q| / q^2
    const double slope = norm(gradient) * (gauge ? r * r : 1);
    volume.add(weight * r * r * r / 3);
    area.add(weight * std::abs(r) * std::hypot(r, slope));
    const double moment = weight * r * r * r * r / 4;
    x.add(moment * u.x);
    y.add(moment * u.y);
    z.add(moment * u.z);
  }
};

}  // namespace

SurfaceMeasures measure(const Expansion& expansion, const Context& context) {
  require_surface(expansion);
  const int degree = expansion.coefficients.degree();
  const bool gauge = expansion.function == RadialFunction::kGauge;
  // Sums are formed in units of the mean radius, whose powers might overflow.
  const double mean = std::abs(expansion.coefficients.c(0, 0)) / std::sqrt(4 * std::numbers::pi);
  if (!(mean > 0)) {
    throw Error(ErrorCode::kInvalidInput, "the mean of the expansion (c_00) is zero: no solid");
  }
  Coefficients unit = expansion.coefficients;
  for (double& value : unit.values()) value /= mean;
  const std::array<Coefficients, 3> gradient = solid_gradient(unit);

  const GaussRule rule = gauss_legendre(2 * degree + 1 + kMoreRings);
  const std::size_t n_theta = rule.nodes.size();
  const int n_phi = 2 * static_cast<int>(n_theta);
  Sums sums;
  for (std::size_t first = 0; first < n_theta; first += kRingsAtOnce) {
    const std::size_t count = std::min(kRingsAtOnce, n_theta - first);
    std::vector<double> colatitudes(count);
    for (std::size_t i = 0; i < count; ++i) colatitudes[i] = std::acos(rule.nodes[first + i]);
    const auto f = evaluate_rings(unit, colatitudes, n_phi, context);
    std::array<std::vector<double>, 3> d;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      d[axis] = evaluate_rings(gradient[axis], colatitudes, n_phi, context);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double z = rule.nodes[first + i], s = std::sqrt(1 - z * z);
      const double weight = rule.weights[first + i] * 2 * std::numbers::pi / n_phi;
      for (int k = 0; k < n_phi; ++k) {
        const double phi = 2 * std::numbers::pi * k / n_phi;
        const Vec3 u = {s * std::cos(phi), s * std::sin(phi), z};
        const std::size_t at = i * static_cast<std::size_t>(n_phi) + static_cast<std::size_t>(k);
        const Vec3 g = {d[0][at], d[1][at], d[2][at]};
        sums.add(u, f[at], g - dot(g, u) * u, gauge, weight);
      }
    }
  }
  const double scale = gauge ? 1 / mean : mean;
  SurfaceMeasures measures;
  measures.volume = sums.volume.value() * scale * scale * scale;
  measures.area = sums.area.value() * scale * scale;
  measures.centroid = expansion.center + (scale / sums.volume.value()) *
                                             Vec3{sums.x.value(), sums.y.value(), sums.z.value()};
  return measures;
}

}  // namespace rholm
