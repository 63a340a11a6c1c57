// What is known of the error in closed form, method 5.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/compensated_sum.h"
#include "base/parallel.h"
#include "rholm/analyze.h"
#include "shape/face.h"
#include "transform/star_geometry.h"

namespace rholm {
namespace {

// Phi_T = int_T dS/|x| = sum_edges rho_e ln((R_1 + R_2 + len)/(R_1 + R_2 - len)) - d_T Omega_T, the
// potential of a plane polygon: the logarithm of (M7) in the form that is stable on both sides
// of the foot of the perpendicular.
double potential(const std::array<Vec3, 3>& p, const Vec3& n, double d) {
  double sum = -d * solid_angle(p);
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

// int r^2 dOmega over a face.
double face_norm(const MeshView& mesh, std::size_t t, const Vec3& center, double scale) {
  std::array<Vec3, 3> p;
  const Triangle triangle = mesh.triangle(t);
  for (int i = 0; i < 3; ++i) p[i] = scale * (mesh.vertex(triangle[i]) - center);
  const FaceNormal normal = face_normal(p);
  if (normal.degenerate) return 0;
  const Vec3 n = normalized(normal.twice_area);
  const Vec3& nearest = *std::min_element(
      p.begin(), p.end(), [](const Vec3& a, const Vec3& b) { return dot(a, a) < dot(b, b); });
  const double d = dot(n, nearest);
  return d * potential(p, n, d);
}

}  // namespace

double radius_norm_squared(const StarChart& chart) {
  return radius_norm_squared(view_of(chart.mesh), {});
}

double radius_norm_squared(const MeshView& mesh, const Vec3& center, const Context& context) {
  const double scale = unit_scale(mesh, center);
  constexpr std::size_t kGrain = 4096;  // chosen: about 1 ms
  std::vector<double> parts((mesh.n_triangles + kGrain - 1) / kGrain);
  parallel_for(mesh.n_triangles, kGrain, context, {"norms", 0, 1},
               [&](std::size_t begin, std::size_t end) {
                 CompensatedSum sum;
                 for (std::size_t t = begin; t < end; ++t)
                   sum.add(face_norm(mesh, t, center, scale));
                 parts[begin / kGrain] = sum.value();
               });
  CompensatedSum sum;
  for (const double part : parts) sum.add(part);
  return sum.value() / (scale * scale);
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

namespace {

// Half-edges that wait for their twins, by the coordinates of their ends: open addressing.
class WaitingEdges {
 public:
  explicit WaitingEdges(std::size_t n_triangles) {
    std::size_t size = 16;
    while (2 * size < 5 * n_triangles) size *= 2;  // 3/2 n edges, at most 60 % full
    slots_.resize(size);
  }
  // Gives back what the twin left, or none and keeps the value.
  std::optional<double> match(std::uint64_t name, double value) {
    name |= 1;  // 0 is an empty slot
    std::size_t at = (name >> 20) & (slots_.size() - 1);
    while (slots_[at].name != 0) {
      if (slots_[at].name == name && !slots_[at].matched) {
        slots_[at].matched = true;
        return slots_[at].value;
      }
      at = (at + 1) & (slots_.size() - 1);
    }
    slots_[at] = {name, value, false};
    return std::nullopt;
  }

 private:
  struct Slot {
    std::uint64_t name = 0;
    double value = 0;
    bool matched = false;
  };
  std::vector<Slot> slots_;
};

std::uint64_t mix(std::uint64_t h) {
  h ^= h >> 31;
  h *= 0xBF58476D1CE4E5B9U;
  return h ^ (h >> 29);
}

std::uint64_t name_of(const Vec3& v) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
  return mix(mix(mix(bits(v.x)) + bits(v.y)) + 3 * bits(v.z));
}

}  // namespace

double tail_strength(const MeshView& mesh, const Vec3& center) {
  const double scale = unit_scale(mesh, center);
  WaitingEdges waiting(mesh.n_triangles);
  CompensatedSum sum;
  for (std::size_t t = 0; t < mesh.n_triangles; ++t) {
    const Triangle triangle = mesh.triangle(t);
    std::array<Vec3, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = scale * (mesh.vertex(triangle[i]) - center);
    const FaceNormal normal = face_normal(p);
    const double d2 = dot(normal.twice_area, p[0]);
    const Vec3 slope = normal.degenerate || d2 == 0 ? Vec3{} : normal.twice_area / d2;
    for (int i = 0; i < 3; ++i) {
      const Vec3 &a = p[i], &b = p[(i + 1) % 3];
      const Vec3 across = cross(a, b);
      const double size = norm(across);
      // On both sides of an edge the same N up to its sign, which the product with the slope keeps.
      const double side = size > 0 ? dot(slope, across) / size : 0.0;
      const std::uint64_t from = name_of(a), to = name_of(b);
      const auto twin = waiting.match(mix(from ^ to) + from + to, side);
      if (!twin) continue;
      const double jump = *twin + side;
      sum.add(jump * jump * size * (dot(a, a) + dot(a, b) + dot(b, b)) / 3);
    }
  }
  return sum.value() / (scale * scale);
}

}  // namespace rholm
