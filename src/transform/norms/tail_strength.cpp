// The tail of the spectrum, from the jumps of the slope across the edges: method 5.
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/cancel.h"
#include "base/compensated_sum.h"
#include "rholm/analyze.h"
#include "shape/face.h"
#include "shape/topology/vertex_place.h"
#include "transform/geometry/star_geometry.h"

namespace rholm {

double tail_strength(const StarChart& chart, RadialFunction function) {
  const StarGeometry geometry = star_geometry(chart);
  CompensatedSum sum;
  CancelPoll poll;
  for (const Edge& edge : chart.edges) {
    poll();
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

}  // namespace

double tail_strength(const MeshView& mesh, const Vec3& center) {
  const double scale = unit_scale(mesh, center);
  WaitingEdges waiting(mesh.n_triangles);
  CompensatedSum sum;
  CancelPoll poll;
  for (std::size_t t = 0; t < mesh.n_triangles; ++t) {
    poll();
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
      const std::uint64_t from = place_hash(a), to = place_hash(b);
      const auto twin = waiting.match(mix_bits(from ^ to) + from + to, side);
      if (!twin) continue;
      const double jump = *twin + side;
      sum.add(jump * jump * size * (dot(a, a) + dot(a, b) + dot(b, b)) / 3);
    }
  }
  return sum.value() / (scale * scale);
}

}  // namespace rholm
