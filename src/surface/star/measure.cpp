// Volume, area and centroid of the solid under a harmonic surface, on a Gauss-Legendre grid:
// V = int r^3/3 dOmega, V c = int r^4/4 u dOmega, A = int r sqrt(r^2 + |grad_S r|^2) dOmega.
// If r has degree L, the first two integrands are polynomials of degree 3L and 4L + 1, which
// the grid integrates exactly.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/compensated_sum.h"
#include "base/refuse.h"
#include "harmonic/coefficients/solid_gradient.h"
#include "rholm/coefficients.h"
#include "rholm/harmonic.h"
#include "rholm/synthesize.h"

namespace rholm {
namespace {

// Integrals over a star-shaped solid share the expansion in units of its mean
// radius, and a Gauss-Legendre grid that is processed by blocks of rings.

// Powers of radii might overflow. Sums are therefore formed from `coefficients`,
// whose mean is 1, and lengths are multiplied by `scale` afterwards.
struct UnitExpansion {
  Coefficients coefficients;
  bool gauge = false;  // true if the coefficients expand 1/r
  double scale = 1;
};

// Throws Unsupported if there is no surface, InvalidInput if the mean is zero.
inline UnitExpansion unit_expansion(const Expansion& expansion) {
  require_surface(expansion);
  UnitExpansion unit{.coefficients = expansion.coefficients,
                     .gauge = expansion.function == RadialFunction::kGauge};
  const double mean = std::abs(unit.coefficients.c(0, 0)) / std::sqrt(4 * std::numbers::pi);
  if (!(mean > 0)) refuse("the mean of the expansion (c_00) is zero: no solid");
  for (double& value : unit.coefficients.values()) value /= mean;
  unit.scale = unit.gauge ? 1 / mean : mean;
  return unit;
}

// Calls evaluate(colatitudes, n_phi) for some Gauss-Legendre rings at a time. Then calls
// visit(values, i, u, weight) for each node i of these rings, ring by ring. Vector u is the
// direction of the node. The sum of all weights is 4 pi. The number n_phi is twice the number of
// rings.
template <typename Evaluate, typename Visit>
void for_each_node(int n_rings, const Evaluate& evaluate, const Visit& visit) {
  constexpr std::size_t kRingsAtOnce = 64;  // chosen: limits memory at high degrees
  const GaussRule rule = gauss_legendre(n_rings);
  const std::size_t n_theta = rule.nodes.size();
  const int n_phi = 2 * n_rings;
  for (std::size_t first = 0; first < n_theta; first += kRingsAtOnce) {
    const std::size_t count = std::min(kRingsAtOnce, n_theta - first);
    std::vector<double> colatitudes(count);
    for (std::size_t i = 0; i < count; ++i) colatitudes[i] = std::acos(rule.nodes[first + i]);
    const auto values = evaluate(colatitudes, n_phi);
    std::size_t node = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double z = rule.nodes[first + i], s = std::sqrt(1 - z * z);
      const double weight = rule.weights[first + i] * 2 * std::numbers::pi / n_phi;
      for (int k = 0; k < n_phi; ++k) {
        const double phi = 2 * std::numbers::pi * k / n_phi;
        visit(values, node++, Vec3{s * std::cos(phi), s * std::sin(phi), z}, weight);
      }
    }
  }
}

// Rings beyond the 2L + 1 that make volume and centroid exact. The area and a gauge need them,
// because their integrands are not polynomials (chosen: an ellipsoid's area converges to 1e-12).
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

namespace {

struct Moments {
  CompensatedSum volume;
  std::array<CompensatedSum, 3> first;
  std::array<CompensatedSum, 6> second;  // xx, yy, zz, xy, xz, yz

  void add(const Vec3& u, double r, double weight) {
    const double r3 = weight * r * r * r, r4 = r3 * r / 4, r5 = r3 * r * r / 5;
    volume.add(r3 / 3);
    const double products[] = {u.x * u.x, u.y * u.y, u.z * u.z, u.x * u.y, u.x * u.z, u.y * u.z};
    const double directions[] = {u.x, u.y, u.z};
    for (std::size_t k = 0; k < 3; ++k) first[k].add(r4 * directions[k]);
    for (std::size_t k = 0; k < 6; ++k) second[k].add(r5 * products[k]);
  }

  // Returns I = tr(M) 1 - M about the centroid, with M = int (x - c)(x - c)^T dV.
  std::array<Vec3, 3> inertia() const {
    const double v = volume.value();
    const double x = first[0].value(), y = first[1].value(), z = first[2].value();
    const double xx = second[0].value() - x * x / v, yy = second[1].value() - y * y / v;
    const double zz = second[2].value() - z * z / v, xy = second[3].value() - x * y / v;
    const double xz = second[4].value() - x * z / v, yz = second[5].value() - y * z / v;
    return {Vec3{yy + zz, -xy, -xz}, Vec3{-xy, xx + zz, -yz}, Vec3{-xz, -yz, xx + yy}};
  }
};

}  // namespace

std::array<Vec3, 3> inertia(const Expansion& expansion, const Context& context) {
  require_star_shaped(expansion, "the tensor of inertia");
  const UnitExpansion unit = unit_expansion(expansion);
  Moments moments;
  for_each_node(
      (5 * unit.coefficients.degree() + 4) / 2 + (unit.gauge ? kMoreRings : 0),
      [&](const std::vector<double>& colatitudes, int n_phi) {
        return evaluate_rings(unit.coefficients, colatitudes, n_phi, context);
      },
      [&](const std::vector<double>& values, std::size_t i, const Vec3& u, double weight) {
        moments.add(u, unit.gauge ? 1 / values[i] : values[i], weight);
      });
  if (!(moments.volume.value() > 0)) {
    refuse("the expansion crosses its centre and has the volume " +
           std::to_string(moments.volume.value()) +
           " (of unit mean radius), which must be above 0");
  }
  const double scale = unit.scale;
  const double fifth_power = scale * scale * scale * scale * scale;
  std::array<Vec3, 3> rows = moments.inertia();
  for (Vec3& row : rows) {
    row = fifth_power * row;
    if (is_finite(row)) continue;
    refuse("inertia is of the fifth power of the unit, which overflows at a mean radius of " +
           std::to_string(scale) + "; take another unit");
  }
  return rows;
}

}  // namespace rholm
