// Moments of the solid under a harmonic surface, on a Gauss-Legendre grid:
//   V = int r^3/3 dOmega,   V c = int r^4/4 u dOmega,   int x x^T dV = int r^5/5 u u^T dOmega.
// With r of degree L the integrands are polynomials of degree 5L + 2 at most, which the grid
// integrates exactly.
#include <array>
#include <string>
#include <vector>

#include "base/compensated_sum.h"
#include "base/refuse.h"
#include "rholm/harmonic.h"
#include "rholm/synthesize.h"
#include "surface/star/sphere_grid.h"

namespace rholm {
namespace {

// Rings beyond those for a gauge, whose integrands are not polynomials (as in measure.cpp).
constexpr int kMoreRings = 48;

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
