// Cubature of r conj(Y) dOmega over the flat faces: r dOmega = d_T dS / |x|^2.
#include <cmath>
#include <numbers>

#include "base/compensated_sum.h"
#include "transform/methods/methods.h"
#include "transform/methods/radius_cubature.h"
#include "transform/methods/sources.h"

namespace rholm {
namespace {

double total_weight(const StarGeometry& geometry) {
  double total = 0;
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) total += radius_weight(geometry, t);
  return total;
}

}  // namespace

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
  const Allowance allowance = undivided_allowance(allowed, total_weight(geometry), 0);
  CompensatedSum sum;
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    visit_radius(geometry, t, allowance, [&](const Vec3&, double w) { sum.add(w); });
  }
  return y00 * sum.value();
}

MethodResult area_method(const StarGeometry& geometry, const MethodOptions& options,
                         const Context& context) {
  Sources sources({.degree = options.degree}, context);
  const Allowance allowance =
      undivided_allowance(options.allowed, total_weight(geometry), options.degree);
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    sources.set_progress(static_cast<double>(t) / static_cast<double>(geometry.faces.size()));
    visit_radius(geometry, t, allowance, [&](const Vec3& x, double w) { sources.add(x, w); });
  }
  MethodResult result;
  result.coefficients = sources.finish();
  result.face_nodes = sources.count();
  result.coefficients.c(0, 0) = radius_mean_coefficient(geometry, options.mean_allowed);
  return result;
}

}  // namespace rholm
