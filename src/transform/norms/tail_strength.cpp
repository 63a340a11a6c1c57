// Computes the tail of the spectrum from the jumps of the slope across the edges: method 5.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "base/compensated_sum.h"
#include "base/parallel.h"
#include "rholm/transform.h"
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
    // r^4 ds = |x|^2 |a x b| dt along the flat edge is quadratic in t.
    const double integral = function == RadialFunction::kGauge
                                ? e.angle
                                : norm(cross(a, b)) * (dot(a, a) + dot(a, b) + dot(b, b)) / 3;
    sum.add(e.jump * e.jump * integral);
  }
  const double scale = geometry.scale * geometry.scale;
  return function == RadialFunction::kGauge ? sum.value() * scale : sum.value() / scale;
}

namespace {

struct HalfEdge {
  std::uint64_t name = 0;  // hash of the coordinates of its ends
  double value = 0;
};

// Half-edges that wait for their twins. The last few thousand wait in a table; older ones, which
// newer ones replace there, wait in a list.
class WaitingEdges {
 public:
  // Adds a half-edge. Calls join(value, value) for two half-edges of the same name.
  template <typename Join>
  void add(std::uint64_t name, double value, const Join& join) {
    name |= 1;  // 0 marks an empty place
    HalfEdge& half = at_hand_[name >> (64 - kBits)];
    if (half.name == name) {
      join(half.value, value);
      half.name = 0;
      return;
    }
    if (half.name != 0) pushed_out_.push_back(half);
    half = {name, value};
  }
  // Returns the half-edges that have not met a twin.
  std::vector<HalfEdge> take_rest() {
    for (const HalfEdge& half : at_hand_) {
      if (half.name != 0) pushed_out_.push_back(half);
    }
    return std::move(pushed_out_);
  }

 private:
  static constexpr int kBits = 12;  // chosen: 64 kB
  std::vector<HalfEdge> at_hand_ = std::vector<HalfEdge>(std::size_t{1} << kBits);
  std::vector<HalfEdge> pushed_out_;
};

// Calls join(value, value) for each two half-edges of the same name.
template <typename Join>
void join_twins(std::vector<HalfEdge>& edges, const Join& join) {
  std::ranges::stable_sort(edges, {}, &HalfEdge::name);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i - 1].name != edges[i].name) continue;
    join(edges[i - 1].value, edges[i].value);
    ++i;
  }
}

// Visits each edge of a face: the face's term of the jump of the slope, times the root of the
// edge's weight.
template <typename Visit>
void visit_sides(const std::array<Vec3, 3>& p, const Visit& visit) {
  std::array<std::uint64_t, 3> place;
  for (std::size_t i = 0; i < 3; ++i) place[i] = place_hash(p[i]);
  const FaceNormal normal = face_normal(p);
  const double d2 = dot(normal.twice_area, p[0]);
  const Vec3 slope = normal.degenerate || d2 == 0 ? Vec3{} : normal.twice_area / d2;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1;
    const Vec3 &a = p[i], &b = p[j];
    const Vec3 across = cross(a, b);
    const double size = norm(across);
    // Both faces of an edge have the same N up to its sign, so their terms add up to the jump.
    const double side = size > 0 ? dot(slope, across) / size : 0.0;
    const double weight = size * (dot(a, a) + dot(a, b) + dot(b, b)) / 3;
    visit(mix_bits(place[i] ^ place[j]) + place[i] + place[j], side * std::sqrt(weight));
  }
}

}  // namespace

double tail_strength(const MeshView& mesh, const Vec3& center, const Context& context) {
  const double scale = unit_scale(mesh, center, context);
  constexpr std::size_t kGrain = 1 << 15;  // chosen: some 2 ms, and few edges between two grains
  struct Part {
    CompensatedSum sum;
    std::vector<HalfEdge> rest;
  };
  std::vector<Part> parts((mesh.n_faces + kGrain - 1) / kGrain);
  parallel_for(mesh.n_faces, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    Part& part = parts[begin / kGrain];
    WaitingEdges waiting;
    const auto join = [&](double one, double other) {
      part.sum.add((one + other) * (one + other));
    };
    for (std::size_t t = begin; t < end; ++t) {
      const Triangle triangle = mesh.triangle(t);
      std::array<Vec3, 3> p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = scale * (mesh.vertex(triangle[i]) - center);
      visit_sides(p, [&](std::uint64_t name, double value) { waiting.add(name, value, join); });
    }
    part.rest = waiting.take_rest();
  });
  CompensatedSum sum;
  std::vector<HalfEdge> rest;
  for (const Part& part : parts) {
    sum.add(part.sum.value());
    rest.insert(rest.end(), part.rest.begin(), part.rest.end());
  }
  join_twins(rest, [&](double one, double other) { sum.add((one + other) * (one + other)); });
  return sum.value() / (scale * scale);
}

}  // namespace rholm
