// The tail of the spectrum, from the jumps of the slope across the edges: method 5.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

// Half-edges that wait for their twins, by the coordinates of their ends. The last few thousand
// are at hand; those that are pushed out wait apart, to be sorted in the end.
class WaitingEdges {
 public:
  // Calls join(value, value) for two of a name.
  template <typename Join>
  void add(std::uint64_t name, double value, const Join& join) {
    name |= 1;  // 0 is an empty place
    Half& half = at_hand_[name >> (64 - kBits)];
    if (half.name == name) {
      join(half.value, value);
      half.name = 0;
      return;
    }
    if (half.name != 0) pushed_out_.push_back(half);
    half = {name, value};
  }
  template <typename Join>
  void finish(const Join& join) {
    for (const Half& half : at_hand_) {
      if (half.name != 0) pushed_out_.push_back(half);
    }
    std::ranges::stable_sort(pushed_out_, {}, &Half::name);
    for (std::size_t i = 1; i < pushed_out_.size(); ++i) {
      if (pushed_out_[i - 1].name != pushed_out_[i].name) continue;
      join(pushed_out_[i - 1].value, pushed_out_[i].value);
      ++i;
    }
  }

 private:
  static constexpr int kBits = 12;  // chosen: 64 kB
  struct Half {
    std::uint64_t name = 0;
    double value = 0;
  };
  std::vector<Half> at_hand_ = std::vector<Half>(std::size_t{1} << kBits);
  std::vector<Half> pushed_out_;
};

}  // namespace

double tail_strength(const MeshView& mesh, const Vec3& center) {
  const double scale = unit_scale(mesh, center);
  WaitingEdges waiting;
  CompensatedSum sum;
  // Of both sides of an edge, each times the root of what it counts.
  const auto join = [&](double one, double other) { sum.add((one + other) * (one + other)); };
  CancelPoll poll;
  for (std::size_t t = 0; t < mesh.n_triangles; ++t) {
    poll();
    const Triangle triangle = mesh.triangle(t);
    std::array<Vec3, 3> p;
    std::array<std::uint64_t, 3> place;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = scale * (mesh.vertex(triangle[i]) - center);
      place[i] = place_hash(p[i]);
    }
    const FaceNormal normal = face_normal(p);
    const double d2 = dot(normal.twice_area, p[0]);
    const Vec3 slope = normal.degenerate || d2 == 0 ? Vec3{} : normal.twice_area / d2;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = i == 2 ? 0 : i + 1;
      const Vec3 &a = p[i], &b = p[j];
      const Vec3 across = cross(a, b);
      const double size = norm(across);
      // On both sides of an edge the same N up to its sign, which the product with the slope keeps.
      const double side = size > 0 ? dot(slope, across) / size : 0.0;
      const double weight = size * (dot(a, a) + dot(a, b) + dot(b, b)) / 3;
      waiting.add(mix_bits(place[i] ^ place[j]) + place[i] + place[j], side * std::sqrt(weight),
                  join);
    }
  }
  waiting.finish(join);
  return sum.value() / (scale * scale);
}

}  // namespace rholm
