// Computes the largest truncation error, which is at a vertex: method 5.
//
// Near a vertex v the Laplacian of f = r or 1/r has jumps j_e of the normal derivative on the edges
// at v. The gauge has j_e = s_e, the radius j_e = -r^2 s_e. The projection on degree l is (2l+1)/(4
// pi) P_l(u . v), and Lap Y = -l(l+1) Y. So an arc that is long against 1/l adds
//   -(2l+1)/(4 pi l(l+1)) j_e int P_l(cos s) ds,    int P_l(cos s) ds -> 1/(l + 1/2),
// to f at v. All degrees beyond L together add
//   (f - f_L)(v) = -sum_e j_e / (2 pi (L+1)) (1 + O(1/L)).
// Inside an edge two such halves meet: twice the edge's jump replaces the sum.
//
// s_e = (a_L - a_R) . N, a_T = n_T/d_T, is the sum of a_T . N_T over its two half-edges. N_T = p_i
// x p_j / |p_i x p_j| has the direction of each half-edge, so that no half-edges need to be paired.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/cancel.h"
#include "rholm/transform.h"
#include "shape/face.h"
#include "shape/topology/vertex_place.h"
#include "transform/geometry/star_geometry.h"

namespace rholm {
namespace {

// Returns for each vertex the first vertex at the same place, by open addressing.
std::vector<std::uint32_t> first_at_place(const MeshView& mesh) {
  const auto n = static_cast<std::uint32_t>(mesh.n_vertices);
  std::size_t size = 16;
  while (2 * size < 3 * mesh.n_vertices) size *= 2;
  constexpr std::uint32_t kFree = 0xFFFFFFFFU;
  std::vector<std::uint32_t> slots(size, kFree), first(n);
  CancelPoll poll;
  for (std::uint32_t i = 0; i < n; ++i) {
    poll();
    const Vec3 v = mesh.vertex(i);
    std::size_t at = place_hash(v) & (size - 1);
    while (slots[at] != kFree && mesh.vertex(slots[at]) != v) at = (at + 1) & (size - 1);
    if (slots[at] == kFree) slots[at] = i;
    first[i] = slots[at];
  }
  return first;
}

// Sums over the faces at a vertex.
struct VertexSums {
  double jumps = 0;  // sum of s_e
  Vec3 slope;        // sum of a_T times the angle of T at the vertex, seen from the centre
};

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

void add_triangle(const std::array<Vec3, 3>& p, const std::array<VertexSums*, 3>& sums) {
  const FaceNormal normal = face_normal(p);
  const double d2 = dot(normal.twice_area, p[0]);
  if (normal.degenerate || d2 == 0) return;
  const Vec3 slope = normal.twice_area / d2;
  // N of the edge from corner i is zero if the edge's ends are in one direction.
  const Vec3 across[3] = {normalized(cross(p[0], p[1])), normalized(cross(p[1], p[2])),
                          normalized(cross(p[2], p[0]))};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &out = across[i], &in = across[(i + 2) % 3];
    sums[i]->jumps += dot(slope, out + in);
    sums[i]->slope += angle_between(out, -in) * slope;
  }
}

}  // namespace

ErrorStrengths vertex_error_strengths(const MeshView& mesh, const Vec3& center) {
  validate(mesh);
  const double scale = unit_scale(mesh, center, {.threads = 1});
  const std::vector<std::uint32_t> first = first_at_place(mesh);
  std::vector<VertexSums> sums(mesh.n_vertices);
  const auto local = [&](std::uint32_t i) { return scale * (mesh.vertex(i) - center); };
  CancelPoll poll;
  for (std::size_t t = 0; t < mesh.n_faces; ++t) {
    poll();
    const Triangle v = mesh.triangle(t);
    add_triangle({local(v[0]), local(v[1]), local(v[2])},
                 {&sums[first[v[0]]], &sums[first[v[1]]], &sums[first[v[2]]]});
  }
  ErrorStrengths largest;
  for (std::uint32_t i = 0; i < mesh.n_vertices; ++i) {
    poll();
    const Vec3 p = local(i);
    const double gauge = std::abs(sums[i].jumps), radius = gauge * dot(p, p);
    // The gradient of f_L at a vertex is the mean of the faces' gradients over directions. The
    // vector a = sum / 2 pi, for which a . u = 1/r, is the normal there, and cos gamma = (a . u) /
    // |a|.
    const double slope = norm(sums[i].slope) / (2 * std::numbers::pi) * norm(p);
    largest.gauge = std::max(largest.gauge, gauge);
    largest.radius = std::max(largest.radius, radius);
    if (slope > 0) largest.distance = std::max(largest.distance, radius / slope);
  }
  return {.radius = largest.radius / scale,
          .gauge = largest.gauge * scale,
          .distance = largest.distance / scale};
}

double vertex_error_strength(const StarChart& chart, RadialFunction function) {
  const ErrorStrengths strengths = vertex_error_strengths(view_of(chart.mesh), {});
  return function == RadialFunction::kGauge ? strengths.gauge : strengths.radius;
}

}  // namespace rholm
