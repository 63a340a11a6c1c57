#include "rholm/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rholm {
namespace {

struct Point2 {
  double x = 0;
  double y = 0;

  friend bool operator==(const Point2&, const Point2&) = default;
};

// Returns twice the signed area of a triangle; positive if counter-clockwise.
double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Returns the corners relative to the first, scaled to at most 1, so that no product overflows or
// underflows. Returns nothing if the extent is zero or beyond the range of a double.
std::vector<Vec3> scaled_corners(const std::vector<Vec3>& vertices,
                                 std::span<const std::uint32_t> corners) {
  const Vec3 origin = vertices[corners[0]];
  double extent = 0;
  for (const std::uint32_t corner : corners) {
    const Vec3 p = vertices[corner] - origin;
    extent = std::max({extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  if (!(extent > 0) || !std::isfinite(extent)) return {};
  std::vector<Vec3> points(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points[i] = (vertices[corners[i]] - origin) / extent;
  }
  return points;
}

// Returns the area vector (Newell): the sum over the fan from the first corner, which is at 0.
Vec3 area_vector(const std::vector<Vec3>& points) {
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) sum += cross(points[i], points[i + 1]);
  return sum;
}

// Drops the coordinate along which the normal is longest. The projection of a flat simple polygon
// is simple; a polygon that is counter-clockwise against its normal stays counter-clockwise.
std::vector<Point2> project(const std::vector<Vec3>& points, const Vec3& normal) {
  const Vec3 size = {std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  std::vector<Point2> projected(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    if (size.x >= size.y && size.x >= size.z) {
      projected[i] = normal.x > 0 ? Point2{p.y, p.z} : Point2{p.z, p.y};
    } else if (size.y >= size.z) {
      projected[i] = normal.y > 0 ? Point2{p.z, p.x} : Point2{p.x, p.z};
    } else {
      projected[i] = normal.z > 0 ? Point2{p.x, p.y} : Point2{p.y, p.x};
    }
  }
  return projected;
}

// Returns true if strictly convex: every turn is to the left, and x rises once and falls once. In a
// star polygon, which also only turns left, x rises more often.
bool is_convex(const std::vector<Point2>& p) {
  const std::size_t n = p.size();
  int changes = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Point2& a = p[i];
    const Point2& b = p[(i + 1) % n];
    const Point2& c = p[(i + 2) % n];
    if (!(turn(a, b, c) > 0)) return false;
    if ((b.x >= a.x) != (c.x >= b.x)) ++changes;
  }
  return changes <= 2;
}

void append_fan(std::span<const std::uint32_t> corners, std::vector<Triangle>& triangles) {
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    triangles.push_back({corners[0], corners[i], corners[i + 1]});
  }
}

// A diagonal lies inside if both of its triangles face in the direction of the whole polygon.
void append_quadrilateral(const std::vector<Vec3>& vertices, std::span<const std::uint32_t> corners,
                          std::vector<Triangle>& triangles) {
  const Vec3 origin = vertices[corners[0]];
  std::array<Vec3, 4> p;
  double extent = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    p[i] = vertices[corners[i]] - origin;
    extent = std::max({extent, std::abs(p[i].x), std::abs(p[i].y), std::abs(p[i].z)});
  }
  if (extent > 0) {
    for (Vec3& q : p) q = q / extent;
  }
  const Vec3 normal = cross(p[2] - p[0], p[3] - p[1]);
  const auto faces_out = [&](std::size_t a, std::size_t b, std::size_t c) {
    return dot(cross(p[b] - p[a], p[c] - p[a]), normal) > 0;
  };
  const bool first = faces_out(0, 1, 2) && faces_out(0, 2, 3);   // diagonal 0-2
  const bool second = faces_out(1, 2, 3) && faces_out(1, 3, 0);  // diagonal 1-3
  const Vec3 d02 = p[2] - p[0];
  const Vec3 d13 = p[3] - p[1];
  const bool shorter_second = dot(d13, d13) < dot(d02, d02);
  if (second && (!first || shorter_second)) {
    triangles.push_back({corners[1], corners[2], corners[3]});
    triangles.push_back({corners[1], corners[3], corners[0]});
  } else {
    append_fan(corners, triangles);
  }
}

// Ring of the remaining corners, with the known facts about each.
struct Ring {
  const std::vector<Point2>& points;
  std::vector<std::uint32_t> next;
  std::vector<std::uint32_t> previous;
  std::vector<char> reflex;  // true if it does not turn left; any triangle that is not an
                             // ear contains a reflex corner
  std::vector<char> ear;

  explicit Ring(const std::vector<Point2>& p)
      : points(p), next(p.size()), previous(p.size()), reflex(p.size()), ear(p.size()) {
    const auto n = static_cast<std::uint32_t>(p.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      next[i] = (i + 1) % n;
      previous[i] = (i + n - 1) % n;
    }
    for (std::uint32_t i = 0; i < n; ++i) reflex[i] = is_reflex(i);
    for (std::uint32_t i = 0; i < n; ++i) ear[i] = is_ear(i);
  }

  bool is_reflex(std::uint32_t i) const {
    return !(turn(points[previous[i]], points[i], points[next[i]]) > 0);
  }

  // Returns true if the corner turns left and no other corner is inside its triangle or on the
  // border. A corner that coincides with one of the triangle's is part of a slit, which joins a
  // hole to the outside; it is no obstacle.
  bool is_ear(std::uint32_t i) const {
    if (reflex[i]) return false;
    const Point2& a = points[previous[i]];
    const Point2& b = points[i];
    const Point2& c = points[next[i]];
    for (std::uint32_t k = next[next[i]]; k != previous[i]; k = next[k]) {
      const Point2& p = points[k];
      if (!reflex[k] || p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  // Updates only both neighbours: the removed corner, an ear, was inside no other ear.
  void remove(std::uint32_t i) {
    const std::uint32_t a = previous[i];
    const std::uint32_t b = next[i];
    next[a] = b;
    previous[b] = a;
    reflex[a] = is_reflex(a);
    reflex[b] = is_reflex(b);
    ear[a] = is_ear(a);
    ear[b] = is_ear(b);
  }
};

void append_clipped_ears(const std::vector<Point2>& points, std::span<const std::uint32_t> corners,
                         std::vector<Triangle>& triangles) {
  Ring ring(points);
  std::size_t left = corners.size();
  std::uint32_t at = 0;
  std::size_t in_vain = 0;  // number of corners passed since the last ear
  while (left > 3 && in_vain < left) {
    if (!ring.ear[at]) {
      at = ring.next[at];
      ++in_vain;
      continue;
    }
    triangles.push_back({corners[ring.previous[at]], corners[at], corners[ring.next[at]]});
    ring.remove(at);
    at = ring.next[ring.next[at]];  // every second corner: fewer slivers than at one corner
    --left;
    in_vain = 0;
  }
  std::vector<std::uint32_t> rest;
  for (std::size_t i = 0; i < left; ++i, at = ring.next[at]) rest.push_back(corners[at]);
  append_fan(rest, triangles);
}

}  // namespace

void triangulate_polygon(const std::vector<Vec3>& vertices, std::span<const std::uint32_t> corners,
                         std::vector<Triangle>& triangles) {
  const std::size_t n = corners.size();
  if (n <= 3) return append_fan(corners, triangles);
  if (n == 4) return append_quadrilateral(vertices, corners, triangles);
  const std::vector<Vec3> points = scaled_corners(vertices, corners);
  const Vec3 normal = points.empty() ? Vec3{} : area_vector(points);
  if (normal == Vec3{}) return append_fan(corners, triangles);
  const std::vector<Point2> projected = project(points, normal);
  if (n > kMaxClippedCorners || is_convex(projected)) return append_fan(corners, triangles);
  append_clipped_ears(projected, corners, triangles);
}

}  // namespace rholm
