// The Delaunay triangulation of points on the unit sphere is their convex hull. The plane of a
// facet cuts off a cap of the sphere without points. The origin is added as one more point. Facets
// through it close the hull of a patch on its inner side.
#include "paper/patches/sphere_delaunay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "paper/patches/hull_facets.h"
#include "rholm/error.h"
#include "shape/topology/half_edges.h"

namespace rholm {
namespace {

std::vector<Vec3> unit_directions(std::span<const Vec3> directions) {
  std::vector<Vec3> units;
  units.reserve(directions.size() + 1);
  for (const Vec3& d : directions) {
    const double size = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    if (!is_finite(d) || !(size > 0)) {
      throw Error(ErrorCode::kInvalidInput, "direction " + std::to_string(units.size()) +
                                                " is zero or not finite; the centre must not be "
                                                "one of the points");
    }
    units.push_back(normalized(d / size));
  }
  return units;
}

// Makes a triangle counter-clockwise, with the smallest index first. Returns false if its plane
// meets the origin, which closes a hemisphere.
bool turn_outwards(std::span<const Vec3> units, Triangle& t) {
  const double volume = dot(units[t[0]], cross(units[t[1]], units[t[2]]));
  if (volume < 0) std::swap(t[1], t[2]);
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  const double twice_area = norm(cross(units[t[1]] - units[t[0]], units[t[2]] - units[t[0]]));
  return std::abs(volume) > 1e-12 * twice_area;  // origin's distance, far above rounding
}

std::vector<Triangle> hull_triangles(std::span<const Vec3> units) {
  std::vector<double> coordinates;
  coordinates.reserve(3 * units.size() + 3);
  for (const Vec3& u : units) coordinates.insert(coordinates.end(), {u.x, u.y, u.z});
  coordinates.insert(coordinates.end(), {0, 0, 0});
  std::vector<Triangle> triangles;
  for (Triangle t : hull_facets(coordinates)) {
    const bool has_origin = *std::max_element(t.begin(), t.end()) == units.size();
    if (!has_origin && turn_outwards(units, t)) triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// Inserts a length into the three shortest edges of a point, in ascending order.
using Shortest = std::array<double, 3>;

void insert(Shortest& shortest, double length) {
  for (double& kept : shortest) {
    if (length < kept) std::swap(length, kept);
  }
}

// Triangles, their neighbours across edges, and marks of triangles too long for the border.
struct Border {
  std::vector<std::array<std::uint32_t, 3>> neighbors;  // kNone at the border
  std::vector<char> is_long;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
};

Border border_of(std::span<const Vec3> units, const std::vector<Triangle>& triangles, double gap) {
  Border border;
  border.neighbors.assign(triangles.size(), {Border::kNone, Border::kNone, Border::kNone});
  std::vector<Shortest> shortest(units.size(), {INFINITY, INFINITY, INFINITY});
  sort_half_edges(units.size(), triangles)
      .for_each_edge([&](std::uint32_t smaller, std::span<const HalfEdge> edge) {
        const double length = norm(units[smaller] - units[edge[0].larger()]);
        insert(shortest[smaller], length);
        insert(shortest[edge[0].larger()], length);
        if (edge.size() != 2) return;
        for (const std::size_t side : {0, 1}) {
          const std::uint32_t corner = edge[side].corner();
          border.neighbors[corner / 3][corner % 3] = edge[1 - side].triangle();
        }
      });
  const auto spacing = [&](std::uint32_t v) {
    return std::isfinite(shortest[v][2]) ? shortest[v][2] : shortest[v][1];
  };
  for (const Triangle& t : triangles) {
    std::array<double, 3> spacings = {spacing(t[0]), spacing(t[1]), spacing(t[2])};
    std::sort(spacings.begin(), spacings.end());  // an isolated point has no short edge
    const double longest =
        std::max({norm(units[t[0]] - units[t[1]]), norm(units[t[1]] - units[t[2]]),
                  norm(units[t[2]] - units[t[0]])});
    border.is_long.push_back(longest > gap * spacings[1]);
  }
  return border;
}

// Removes long triangles from the border inwards; the result does not depend on the order.
std::vector<Triangle> peeled(std::span<const Vec3> units, const std::vector<Triangle>& triangles,
                             double gap) {
  const Border border = border_of(units, triangles, gap);
  std::vector<char> is_gone(triangles.size(), 0);
  std::vector<std::uint32_t> open;
  const auto take = [&](std::uint32_t t) {
    if (t == Border::kNone || is_gone[t] || !border.is_long[t]) return;
    is_gone[t] = 1;
    open.push_back(t);
  };
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& near = border.neighbors[t];
    if (std::find(near.begin(), near.end(), Border::kNone) != near.end()) take(t);
  }
  while (!open.empty()) {
    const std::uint32_t t = open.back();
    open.pop_back();
    for (const std::uint32_t other : border.neighbors[t]) take(other);
  }
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!is_gone[t]) kept.push_back(triangles[t]);
  }
  return kept;
}

}  // namespace

std::vector<Triangle> sphere_delaunay(std::span<const Vec3> directions,
                                      const DelaunayOptions& options) {
  if (directions.size() > 100000000) {
    throw Error(ErrorCode::kInvalidInput, "there are " + std::to_string(directions.size()) +
                                              " directions; at most 1e8 fit Qhull's indices");
  }
  const std::vector<Vec3> units = unit_directions(directions);
  if (units.size() < 3) return {};
  std::vector<Triangle> triangles = hull_triangles(units);
  if (triangles.empty() || !(options.gap < INFINITY)) return triangles;
  return peeled(units, triangles, options.gap);
}

}  // namespace rholm
