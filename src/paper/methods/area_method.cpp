// Cubature of r conj(Y) dOmega over the flat faces: r dOmega = d_T dS / |x|^2.
#include "paper/methods/paper_methods.h"
#include "transform/methods/methods.h"
#include "transform/methods/radius_cubature.h"
#include "transform/methods/sources.h"

namespace rholm {

MethodResult area_method(const StarGeometry& geometry, const MethodOptions& options,
                         const Context& context) {
  Sources sources({.degree = options.degree}, context);
  const Allowance allowance =
      undivided_allowance(options.allowed, radius_weight(geometry), options.degree);
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
