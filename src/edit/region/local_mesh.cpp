#include "edit/region/local_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "shape/normal_attributes.h"
#include "shape/topology/identical.h"

namespace rholm {
namespace {

bool inside(const Bounds& box, const Vec3& p) {
  return p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z && p.x <= box.max.x &&
         p.y <= box.max.y && p.z <= box.max.z;
}

// Returns the vertices of the chosen corners, ascending, and sets `place` to their positions.
std::vector<std::uint32_t> used_vertices(std::size_t n_vertices,
                                         std::span<const std::uint32_t> corners,
                                         std::vector<std::uint32_t>& place) {
  place.assign(n_vertices, 0);
  for (const std::uint32_t v : corners) place[v] = 1;
  std::vector<std::uint32_t> used;
  for (std::uint32_t v = 0; v < n_vertices; ++v) {
    if (place[v] == 0) continue;
    place[v] = static_cast<std::uint32_t>(used.size());
    used.push_back(v);
  }
  return used;
}

// Replaces the vertex indices in `corners` by indices of points.
void number_points(const Mesh& mesh, std::vector<std::uint32_t>& corners, LocalMesh& local) {
  std::vector<std::uint32_t> place;
  const std::vector<std::uint32_t> used = used_vertices(mesh.vertices.size(), corners, place);
  std::vector<Vec3> positions;
  positions.reserve(used.size());
  for (const std::uint32_t v : used) positions.push_back(mesh.vertices[v]);
  const std::vector<std::uint32_t> first = first_identical(positions);
  std::vector<std::uint32_t> point(used.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (first[i] != i) {
      point[i] = point[first[i]];
      continue;
    }
    point[i] = static_cast<std::uint32_t>(local.points.size());
    local.points.push_back(positions[i]);
  }
  local.members_begin.assign(local.points.size() + 1, 0);
  for (const std::uint32_t p : point) ++local.members_begin[p + 1];
  std::partial_sum(local.members_begin.begin(), local.members_begin.end(),
                   local.members_begin.begin());
  local.members.resize(used.size());
  std::vector<std::uint32_t> next(local.members_begin.begin(), local.members_begin.end() - 1);
  for (std::size_t i = 0; i < used.size(); ++i) local.members[next[point[i]]++] = used[i];
  for (std::uint32_t& corner : corners) corner = point[place[corner]];
}

}  // namespace

double median_edge(std::span<const Vec3> points, std::span<const Triangle> triangles,
                   std::span<const double> weights) {
  std::vector<double> lengths;
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      if (weights[from] > 0) lengths.push_back(norm(points[to] - points[from]));
    }
  }
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

LocalMesh cut_out(const Mesh& mesh, const Bounds& box) {
  std::vector<std::uint8_t> in(mesh.vertices.size());
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = inside(box, mesh.vertices[i]) ? 1 : 0;
  std::vector<std::uint32_t> corners;
  for (const Triangle& t : mesh.faces) {
    if ((in[t[0]] | in[t[1]] | in[t[2]]) != 0) corners.insert(corners.end(), t.begin(), t.end());
  }
  LocalMesh local;
  number_points(mesh, corners, local);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Triangle t = {corners[i], corners[i + 1], corners[i + 2]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) local.faces.push_back(t);
  }
  local.stars = make_vertex_stars(local.points.size(), local.faces);
  local.areas.assign(local.points.size(), 0);
  for (const Triangle& t : local.faces) {
    const double area = norm(cross(local.points[t[1]] - local.points[t[0]],
                                   local.points[t[2]] - local.points[t[0]])) /
                        2;
    for (const std::uint32_t v : t) local.areas[v] += area / 3;
  }
  local.normals = point_normals(local, local.points);
  return local;
}

std::vector<Vec3> point_normals(const LocalMesh& local, std::span<const Vec3> positions) {
  std::vector<Vec3> normals = area_normals(positions, local.faces);
  for (Vec3& n : normals) n = normalized(n);
  return normals;
}

void update_normals(Mesh& mesh, std::span<const std::uint32_t> vertices) {
  const NormalAttributes normals = normal_attributes(mesh);
  if (!normals) return;
  const std::vector<Vec3> sums = area_normals(mesh.vertices, mesh.faces);
  for (const std::uint32_t v : vertices) normals.set(v, normalized(sums[v]));
}

namespace {

// Returns the distance of c across the triangle from two corners a, b with known distances. The
// source is unfolded into the plane beyond ab. If its straight line to c does not cross ab, the
// result is the distance along an edge.
double across(const Vec3& a, const Vec3& b, const Vec3& c, double at_a, double at_b) {
  const Vec3 ab = b - a, ac = c - a;
  const double length = norm(ab);
  const double along_edge = std::min(at_a + norm(ac), at_b + norm(c - b));
  if (!(length > 0)) return along_edge;
  // Coordinates: a at 0, b at (length, 0), c above, the source below.
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
      const Triangle& corners = local.faces[t];
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
