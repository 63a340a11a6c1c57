// Norms in closed form, method 5.
#include <cmath>

#include "base/compensated_sum.h"
#include "rholm/transform.h"
#include "transform/geometry/star_geometry.h"
#include "transform/norms/exact_norms.h"

namespace rholm {

double radius_norm_squared(const StarChart& chart) {
  return radius_norm_squared(view_of(chart.mesh), {});
}

double radius_norm_squared(const MeshView& mesh, const Vec3& center, const Context& context) {
  return exact_norms(mesh, center, context).radius_squared;
}

double gauge_norm_squared(const StarChart& chart) {
  const StarGeometry geometry = star_geometry(chart);
  CompensatedSum sum;
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    const FaceGeometry& face = geometry.faces[t];
    if (face.degenerate || face.d == 0) continue;
    const Vec3 a = face.twice_area / (norm(face.twice_area) * face.d);
    sum.add(dot(a, second_moment(geometry.corners(t), face.solid_angle, a)));
  }
  return sum.value() * geometry.scale * geometry.scale;
}

}  // namespace rholm
