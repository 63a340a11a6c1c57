// Cubature of r dOmega over the flat faces: the mean, and terms that are not divided by l(l+1).
#include <cmath>
#include <numbers>

#include "base/compensated_sum.h"
#include "transform/methods/methods.h"
#include "transform/methods/radius_cubature.h"

namespace rholm {

Allowance undivided_allowance(double allowed, double weight, int degree) {
  const double pi = std::numbers::pi;
  return {.allowed = allowed / weight,
          .first = (degree + 1) / std::sqrt(4 * pi),
          .last = (degree + 1) / std::sqrt(12 * pi),
          .degree = degree,
          .growth = Growth::kFlatInverseSquare};
}

double radius_mean_coefficient(const StarGeometry& geometry, double allowed) {
  const double y00 = 1 / std::sqrt(4 * std::numbers::pi);
  const Allowance allowance = undivided_allowance(allowed, radius_weight(geometry), 0);
  CompensatedSum sum;
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    visit_radius(geometry, t, allowance, [&](const Vec3&, double w) { sum.add(w); });
  }
  return y00 * sum.value();
}

}  // namespace rholm
