#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "edit/region/local_mesh.h"

namespace rholm {
namespace {

// The distance of c across the triangle from two corners a, b of known distances: as if all lay in
// a plane with one source beyond ab, if the straight way crosses ab, else along an edge.
double across(const Vec3& a, const Vec3& b, const Vec3& c, double at_a, double at_b) {
  const Vec3 ab = b - a, ac = c - a;
  const double length = norm(ab);
  const double along_edge = std::min(at_a + norm(ac), at_b + norm(c - b));
  if (!(length > 0)) return along_edge;
  // a at 0, b at (length, 0), c above, the source below.
  const double cx = dot(ac, ab) / length;
  const double cy = std::sqrt(std::max(0.0, dot(ac, ac) - cx * cx));
  const double sx = (at_a * at_a - at_b * at_b + length * length) / (2 * length);
  const double sy2 = at_a * at_a - sx * sx;
  if (!(sy2 >= 0)) return along_edge;
  const double sy = std::sqrt(sy2);
  const double crossing = cy + sy > 0 ? sx + (cx - sx) * sy / (cy + sy) : sx;
  if (crossing < 0 || crossing > length) return along_edge;
  return std::hypot(cx - sx, cy + sy);
}

}  // namespace

void march(const LocalMesh& local, double limit, std::vector<double>& distance) {
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::vector<std::uint8_t> done(local.points.size(), 0);
  for (std::uint32_t i = 0; i < distance.size(); ++i) {
    if (distance[i] <= limit) open.emplace(distance[i], i);
  }
  while (!open.empty()) {
    const auto [d, v] = open.top();
    open.pop();
    if (done[v] != 0 || d > distance[v]) continue;
    done[v] = 1;
    for (const std::uint32_t t : local.triangles_at(v)) {
      const Triangle& corners = local.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t c = corners[k], other = corners[(k + 1) % 3] == v
                                                        ? corners[(k + 2) % 3]
                                                        : corners[(k + 1) % 3];
        if (c == v || done[c] != 0) continue;
        const double reached = done[other] != 0 ? across(local.points[v], local.points[other],
                                                         local.points[c], d, distance[other])
                                                : d + norm(local.points[c] - local.points[v]);
        if (reached < distance[c] && reached <= limit) {
          distance[c] = reached;
          open.emplace(reached, c);
        }
      }
    }
  }
}

}  // namespace rholm
