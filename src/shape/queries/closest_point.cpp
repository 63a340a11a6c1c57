#include "shape/queries/closest_point.h"

#include <algorithm>

namespace rholm {
namespace {

double squared(const Vec3& a) { return dot(a, a); }

// Of the two shorter edges, whose cross product loses the least to cancellation.
Vec3 triangle_normal(const std::array<Vec3, 3>& edges) {
  const double l0 = squared(edges[0]), l1 = squared(edges[1]), l2 = squared(edges[2]);
  if (l0 >= l1 && l0 >= l2) return cross(edges[1], edges[2]);
  return l1 >= l2 ? cross(edges[2], edges[0]) : cross(edges[0], edges[1]);
}

}  // namespace

Vec3 closest_point_of_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double along = dot(p - a, edge);
  const double length2 = squared(edge);
  if (!(along > 0)) return a;
  if (along >= length2) return b;
  return a + (along / length2) * edge;
}

// The closest point e of the boundary first; then, if p projects into the inside, e's step onto the
// plane's foot point. Measured from e, an error in the normal of a sliver only touches the distance
// in proportion, and the distance can never exceed that of the boundary.
Vec3 closest_point_of_triangle(const Vec3& p, const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const std::array<Vec3, 3> edges = {b - a, c - b, a - c};
  Vec3 best = closest_point_of_segment(p, a, b);
  for (const Vec3& candidate :
       {closest_point_of_segment(p, b, c), closest_point_of_segment(p, c, a)}) {
    if (squared(p - candidate) < squared(p - best)) best = candidate;
  }
  const Vec3 normal = triangle_normal(edges);
  const double normal2 = squared(normal);
  if (!(normal2 > 0)) return best;
  for (int k = 0; k < 3; ++k) {
    if (dot(cross(normal, edges[k]), p - corners[k]) < 0) return best;
  }
  const Vec3 foot = p - (dot(normal, p - best) / normal2) * normal;
  return squared(p - foot) <= squared(p - best) ? foot : best;  // also if foot has overflowed
}

}  // namespace rholm
