#include "shape/queries/closest_point.h"

#include <algorithm>

namespace rholm {
namespace {

double squared(const Vec3& a) { return dot(a, a); }

// Uses the two shorter edges, whose cross product loses least to cancellation.
Vec3 triangle_normal(const std::array<Vec3, 3>& edges) {
  const double l0 = squared(edges[0]), l1 = squared(edges[1]), l2 = squared(edges[2]);
  if (l0 >= l1 && l0 >= l2) return cross(edges[1], edges[2]);
  return l1 >= l2 ? cross(edges[2], edges[0]) : cross(edges[0], edges[1]);
}

// The closest point of an edge, with its squared distance from p.
struct Foot {
  Vec3 point;
  double distance2;
};
inline Foot foot_on_edge(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& edge) {
  const double along = dot(p - a, edge);
  const double length2 = squared(edge);
  Vec3 point = a;
  if (along > 0) point = along >= length2 ? b : a + (along / length2) * edge;
  return {point, squared(p - point)};
}

}  // namespace

Vec3 closest_point_of_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  return foot_on_edge(p, a, b, b - a).point;
}

// Finds the closest point e of the boundary first. If p projects into the triangle, it moves from e
// to the foot point on the plane. So an error in a sliver's normal changes the distance only in
// proportion, and the distance never exceeds the distance to the boundary.
Vec3 closest_point_of_triangle(const Vec3& p, const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const std::array<Vec3, 3> edges = {b - a, c - b, a - c};
  Foot best = foot_on_edge(p, a, b, edges[0]);
  for (int k = 1; k < 3; ++k) {
    const Foot next = foot_on_edge(p, corners[k], corners[(k + 1) % 3], edges[k]);
    if (next.distance2 < best.distance2) best = next;
  }
  const Vec3 normal = triangle_normal(edges);
  const double normal2 = squared(normal);
  if (!(normal2 > 0)) return best.point;
  for (int k = 0; k < 3; ++k) {
    if (dot(cross(normal, edges[k]), p - corners[k]) < 0) return best.point;
  }
  const Vec3 foot = p - (dot(normal, p - best.point) / normal2) * normal;
  return squared(p - foot) <= best.distance2 ? foot : best.point;  // also if foot overflows
}

}  // namespace rholm
