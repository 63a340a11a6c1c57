// Moments of the solid under a harmonic surface, on a Gauss-Legendre grid:
//   V = int r^3/3 dOmega,   V c = int r^4/4 u dOmega,   int x x^T dV = int r^5/5 u u^T dOmega.
// With r of degree L the integrands are polynomials of degree 5L + 2 at most, which the grid
// integrates exactly.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/compensated_sum.h"
#include "base/refuse.h"
#include "rholm/harmonic.h"
#include "rholm/synthesize.h"

namespace rholm {
namespace {

// Rings beyond those for a gauge, whose integrands are not polynomials (as in measure.cpp).
constexpr int kMoreRings = 48;
constexpr std::size_t kRingsAtOnce = 64;  // chosen: bounds the memory at high degrees

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

  // About the centroid, I = tr(M) 1 - M with M = int (x - c)(x - c)^T dV.
  std::array<Vec3, 3> inertia() const {
    const double v = volume.value();
    const double x = first[0].value(), y = first[1].value(), z = first[2].value();
    const double xx = second[0].value() - x * x / v, yy = second[1].value() - y * y / v;
    const double zz = second[2].value() - z * z / v, xy = second[3].value() - x * y / v;
    const double xz = second[4].value() - x * z / v, yz = second[5].value() - y * z / v;
    return {Vec3{yy + zz, -xy, -xz}, Vec3{-xy, xx + zz, -yz}, Vec3{-xz, -yz, xx + yy}};
  }
};

Moments moments_of(const Coefficients& f, bool gauge, const Context& context) {
  const int degree = f.degree();
  const GaussRule rule = gauss_legendre((5 * degree + 4) / 2 + (gauge ? kMoreRings : 0));
  const std::size_t n_theta = rule.nodes.size();
  const int n_phi = 2 * static_cast<int>(n_theta);
  Moments moments;
  for (std::size_t begin = 0; begin < n_theta; begin += kRingsAtOnce) {
    const std::size_t count = std::min(kRingsAtOnce, n_theta - begin);
    std::vector<double> colatitudes(count);
    for (std::size_t i = 0; i < count; ++i) colatitudes[i] = std::acos(rule.nodes[begin + i]);
    const std::vector<double> values = evaluate_rings(f, colatitudes, n_phi, context);
    for (std::size_t i = 0; i < count; ++i) {
      const double z = rule.nodes[begin + i], s = std::sqrt(1 - z * z);
      const double weight = rule.weights[begin + i] * 2 * std::numbers::pi / n_phi;
      for (int k = 0; k < n_phi; ++k) {
        const double phi = 2 * std::numbers::pi * k / n_phi;
        const double value =
            values[i * static_cast<std::size_t>(n_phi) + static_cast<std::size_t>(k)];
        moments.add({s * std::cos(phi), s * std::sin(phi), z}, gauge ? 1 / value : value, weight);
      }
    }
  }
  return moments;
}

}  // namespace

std::array<Vec3, 3> inertia(const Expansion& expansion, const Context& context) {
  require_surface(expansion);
  // Sums are formed in units of the mean radius, whose powers might overflow.
  const double mean = std::abs(expansion.coefficients.c(0, 0)) / std::sqrt(4 * std::numbers::pi);
  if (!(mean > 0)) refuse("the mean of the expansion (c_00) is zero: no solid");
  Coefficients unit = expansion.coefficients;
  for (double& value : unit.values()) value /= mean;
  const bool gauge = expansion.function == RadialFunction::kGauge;
  const Moments moments = moments_of(unit, gauge, context);
  if (!(moments.volume.value() > 0)) {
    refuse("the expansion crosses its centre and has the volume " +
           std::to_string(moments.volume.value()) +
           " (of unit mean radius), which must be above 0");
  }
  const double scale = gauge ? 1 / mean : mean;
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
