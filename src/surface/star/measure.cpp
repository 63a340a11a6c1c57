// Volume, area and centroid of the solid under a harmonic surface, on a Gauss-Legendre grid:
//   V = int r^3/3 dOmega,   V c = int r^4/4 u dOmega,   A = int r sqrt(r^2 + |grad_S r|^2) dOmega.
// With r of degree L the first two integrands are polynomials of degree 3L and 4L + 1, which the
// grid integrates exactly.
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "base/compensated_sum.h"
#include "harmonic/coefficients/solid_gradient.h"
#include "rholm/harmonic.h"
#include "rholm/synthesize.h"
#include "surface/star/sphere_grid.h"

namespace rholm {
namespace {

// Rings beyond the 2L + 1 that make volume and centroid exact, for the area and for a gauge, whose
// integrands are not polynomials (chosen: an ellipsoid's area then converges to 1e-12).
constexpr int kMoreRings = 48;

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

std::optional<double> SurfaceMeasures::sphericity() const {
  if (!volume || !area) return std::nullopt;
  if (!(*volume > 0) || !(*area > 0)) return 0;
  const double edge = std::cbrt(*volume);
  return std::cbrt(36 * std::numbers::pi) * edge * (edge / *area);
}

SurfaceMeasures measure(const Expansion& expansion, const Context& context) {
  const UnitExpansion unit = unit_expansion(expansion);
  if (expansion.signed_sum) return {};
  const std::array<Coefficients, 3> gradient = solid_gradient(unit.coefficients);
  struct Rings {
    std::vector<double> values;
    std::array<std::vector<double>, 3> gradients;
  };
  Sums sums;
  for_each_node(
      2 * unit.coefficients.degree() + 1 + kMoreRings,
      [&](const std::vector<double>& colatitudes, int n_phi) {
        Rings rings{.values = evaluate_rings(unit.coefficients, colatitudes, n_phi, context),
                    .gradients = {}};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          rings.gradients[axis] = evaluate_rings(gradient[axis], colatitudes, n_phi, context);
        }
        return rings;
      },
      [&](const Rings& rings, std::size_t i, const Vec3& u, double weight) {
        const Vec3 g = {rings.gradients[0][i], rings.gradients[1][i], rings.gradients[2][i]};
        sums.add(u, rings.values[i], g - dot(g, u) * u, unit.gauge, weight);
      });
  const double scale = unit.scale;
  SurfaceMeasures measures;
  measures.volume = sums.volume.value() * scale * scale * scale;
  measures.area = sums.area.value() * scale * scale;
  measures.centroid = expansion.center + (scale / sums.volume.value()) *
                                             Vec3{sums.x.value(), sums.y.value(), sums.z.value()};
  return measures;
}

}  // namespace rholm
