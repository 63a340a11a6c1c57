// What is known of the error in closed form, method 5.
#include <array>
#include <cmath>

#include "base/compensated_sum.h"
#include "rholm/analyze.h"
#include "transform/star_geometry.h"

namespace rholm {
namespace {

// Phi_T = int_T dS/|x| = sum_edges rho_e ln((R_1 + R_2 + len)/(R_1 + R_2 - len)) - d_T Omega_T, the
// potential of a plane polygon: the logarithm of (M7) in the form that is stable on both sides
// of the foot of the perpendicular.
double potential(const std::array<Vec3, 3>& p, const FaceGeometry& face) {
  const Vec3 n = face.twice_area / norm(face.twice_area);
  double sum = -face.d * face.solid_angle;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % 3];
    const Vec3 e = b - a;
    const double length = norm(e);
    if (length == 0) continue;
    const double rho = dot(n, cross(a, e)) / length;
    const double ends = norm(a) + norm(b);
    if (rho != 0) sum += rho * std::log1p(2 * length / (ends - length));
  }
  return sum;
}

}  // namespace

double radius_norm_squared(const StarChart& chart) {
  const StarGeometry geometry = star_geometry(chart);
  CompensatedSum sum;
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    const FaceGeometry& face = geometry.faces[t];
    if (!face.degenerate) sum.add(face.d * potential(geometry.corners(t), face));
  }
  return sum.value() / (geometry.scale * geometry.scale);
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

double tail_strength(const StarChart& chart, RadialFunction function) {
  const StarGeometry geometry = star_geometry(chart);
  CompensatedSum sum;
  for (const Edge& edge : chart.edges) {
    const EdgeJump e = edge_jump(geometry, edge);
    const Vec3 &a = geometry.vertices[edge.a], &b = geometry.vertices[edge.b];
    // r^4 ds = |x|^2 |a x b| dt along the flat edge, quadratic in t.
    const double integral = function == RadialFunction::kGauge
                                ? e.angle
                                : norm(cross(a, b)) * (dot(a, a) + dot(a, b) + dot(b, b)) / 3;
    sum.add(e.jump * e.jump * integral);
  }
  const double scale = geometry.scale * geometry.scale;
  return function == RadialFunction::kGauge ? sum.value() * scale : sum.value() / scale;
}

}  // namespace rholm
