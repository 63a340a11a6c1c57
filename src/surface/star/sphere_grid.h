// What integrals over a star-shaped solid have in common: the expansion in units of its mean
// radius, and a Gauss-Legendre grid that is gone through by blocks of rings.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "base/refuse.h"
#include "rholm/coefficients.h"
#include "rholm/harmonic.h"

namespace rholm {

// Powers of radii might overflow: sums are formed of `coefficients`, whose mean is 1, and lengths
// multiplied by `scale` after.
struct UnitExpansion {
  Coefficients coefficients;
  bool gauge = false;  // 1/r
  double scale = 1;
};

// Throws Unsupported for what is no surface, InvalidInput where the mean is zero.
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

// Calls evaluate(colatitudes, n_phi) for some rings of Gauss-Legendre at a time, then
// visit(values, i, u, weight) for each node i of them, ring by ring: its direction u, and weights
// whose sum is 4 pi. n_phi is twice the number of rings.
template <typename Evaluate, typename Visit>
void for_each_node(int n_rings, const Evaluate& evaluate, const Visit& visit) {
  constexpr std::size_t kRingsAtOnce = 64;  // chosen: bounds the memory at high degrees
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

}  // namespace rholm
