#include "transform/geometry/star_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/compensated_sum.h"
#include "rholm/error.h"
#include "shape/face.h"
#include "shape/vertex_range.h"

namespace rholm {
namespace {

Vec3 slope(const FaceGeometry& face) {
  if (face.degenerate || face.d == 0) return {0, 0, 0};
  return face.twice_area / (norm(face.twice_area) * face.d);
}

}  // namespace

double solid_angle(const std::array<Vec3, 3>& corners) {
  const Vec3 p = normalized(corners[0]), q = normalized(corners[1]), r = normalized(corners[2]);
  return 2 * std::atan2(dot(p, cross(q, r)), 1 + dot(p, q) + dot(q, r) + dot(r, p));
}

double grazing_slope(int degree) {
  return std::min(kGrazingSlope, 1.0 / (8 * std::max(degree, 1)));
}

Vec3 second_moment(const std::array<Vec3, 3>& corners, double omega, const Vec3& v) {
  Vec3 result = (omega / 3) * v;
  for (int i = 0; i < 3; ++i) {
    const Vec3 p = normalized(corners[i]), q = normalized(corners[(i + 1) % 3]);
    const Vec3 across = cross(p, q);
    const double size = norm(across);
    if (size == 0) continue;
    const Vec3 along = across / size;
    const double angle = std::atan2(size, dot(p, q));
    const Vec3 w = std::sin(angle) * p + (1 - std::cos(angle)) * cross(along, p);
    const Vec3 nu = -along;
    result -= (1.0 / 6) * (dot(w, v) * nu + dot(nu, v) * w);
  }
  return result;
}

double unit_scale(const MeshView& mesh, const Vec3& center, const Context& context) {
  double largest = 0;
  if (mesh.n_vertices > 0) {
    const VertexRange range = vertex_range(mesh, context);
    if (!range.finite) validate(mesh);  // throws and names the coordinate
    const double c[3] = {center.x, center.y, center.z};
    for (int k = 0; k < 3; ++k) {
      largest = std::max({largest, std::abs(range.min[k] - c[k]), std::abs(range.max[k] - c[k])});
    }
  }
  // Within these limits the scale, its square and values that are scaled back are normal numbers.
  if (!(largest > 1e-150 && largest < 1e150)) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("the largest coordinate from the centre is {:g}, outside 1e-150 ... "
                            "1e150: choose another unit of length",
                            largest));
  }
  return std::exp2(-std::ilogb(largest));
}

StarGeometry star_geometry(const StarChart& chart) {
  StarGeometry geometry;
  geometry.chart = &chart;
  geometry.scale = unit_scale(view_of(chart.mesh), {}, {.threads = 1});
  geometry.vertices.reserve(chart.mesh.vertices.size());
  for (const Vec3& v : chart.mesh.vertices) geometry.vertices.push_back(geometry.scale * v);
  geometry.faces.resize(chart.mesh.faces.size());
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    const std::array<Vec3, 3> p = geometry.corners(t);
    const FaceNormal normal = face_normal(p);
    FaceGeometry& face = geometry.faces[t];
    face.twice_area = normal.twice_area;
    face.degenerate = normal.degenerate;
    if (face.degenerate) continue;
    // The corner nearest to the centre loses least to rounding.
    const Vec3& nearest = *std::min_element(
        p.begin(), p.end(), [](const Vec3& a, const Vec3& b) { return dot(a, a) < dot(b, b); });
    face.d = dot(face.twice_area, nearest) / norm(face.twice_area);
    face.solid_angle = solid_angle(p);
  }
  return geometry;
}

EdgeJump edge_jump(const StarGeometry& geometry, const Edge& edge) {
  const Vec3& a = geometry.vertices[edge.a];
  const Vec3& b = geometry.vertices[edge.b];
  const Vec3 across = cross(a, b);
  const double size = norm(across);
  EdgeJump result;
  if (size == 0) return result;
  result.normal = across / size;
  result.angle = std::atan2(size, dot(a, b));
  result.jump =
      dot(slope(geometry.faces[edge.left]) - slope(geometry.faces[edge.right]), result.normal);
  return result;
}

double closure_residual(const StarGeometry& geometry) {
  CompensatedSum x, y, z, total;
  for (const Edge& edge : geometry.chart->edges) {
    const EdgeJump e = edge_jump(geometry, edge);
    const Vec3 p = normalized(geometry.vertices[edge.a]);
    const Vec3 along = std::sin(e.angle) * p + (1 - std::cos(e.angle)) * cross(e.normal, p);
    x.add(e.jump * along.x);
    y.add(e.jump * along.y);
    z.add(e.jump * along.z);
    total.add(std::abs(e.jump) * e.angle);
  }
  if (!(total.value() > 0)) return 0;
  return norm({x.value(), y.value(), z.value()}) / total.value();
}

MeanAndNorm mean_and_norm(const StarGeometry& geometry, RadialFunction function) {
  // Calls visit(f, weight) at the corners and the centroid of every face.
  const auto for_each_value = [&](const auto& visit) {
    for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
      const double omega = std::abs(geometry.faces[t].solid_angle);
      if (omega == 0) continue;
      const std::array<Vec3, 3> p = geometry.corners(t);
      const auto at = [&](const Vec3& x, double weight) {
        const double r = norm(x);
        if (r > 0) visit(function == RadialFunction::kRadius ? r : 1 / r, weight * omega);
      };
      for (const Vec3& corner : p) at(corner, 1.0 / 12);
      at((p[0] + p[1] + p[2]) / 3.0, 0.75);
    }
  };
  CompensatedSum sum, solid, square;
  for_each_value([&](double f, double weight) {
    sum.add(weight * f);
    solid.add(weight);
  });
  if (!(solid.value() > 0)) return {};
  const double mean = sum.value() / solid.value();
  for_each_value([&](double f, double weight) { square.add(weight * (f - mean) * (f - mean)); });
  return {mean, std::sqrt(square.value())};
}

}  // namespace rholm
