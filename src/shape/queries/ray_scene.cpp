// Computes crossings in double precision, which both ways of tracing rays have in common.
#include "shape/queries/ray_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rholm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Returns the distance along the ray to the plane of a triangle that the ray meets. The float hit
// is exact only to 1e-7 of the mesh's size, too close to the 1e-6 that separates hits.
double plane_distance(const std::array<Vec3, 3>& corners, const Vec3& origin,
                      const Vec3& direction) {
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  return dot(normal, corners[0] - origin) / dot(normal, direction);
}

}  // namespace

std::vector<RayCrossing> RayScene::crossings(const Vec3& origin, const Vec3& direction) const {
  const Vec3 q = frame_.to_local(origin);
  std::vector<RayCrossing> crossings;
  for (const std::uint32_t triangle : triangles_met(origin, direction)) {
    const auto& [a, b, c] = mesh_.faces[triangle];
    const std::vector<Vec3>& vertices = mesh_.vertices;
    const double t = plane_distance(
        {frame_.to_local(vertices[a]), frame_.to_local(vertices[b]), frame_.to_local(vertices[c])},
        q, direction);
    if (std::isfinite(t)) crossings.push_back({triangle, t / frame_.scale});
  }
  std::sort(crossings.begin(), crossings.end(), [](const RayCrossing& a, const RayCrossing& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
  });
  return crossings;
}

int RayScene::count_hits(const Vec3& origin, const Vec3& direction) const {
  int count = 0;
  double last = -kInfinity;
  for (const RayCrossing& crossing : crossings(origin, direction)) {
    count += crossing.distance - last > 1e-6 * std::abs(crossing.distance);
    last = crossing.distance;
  }
  return count;
}

}  // namespace rholm
