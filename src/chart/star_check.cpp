// The star check from a given centre. Source: method 6.
//
// A closed mesh is star-shaped from c when every face turns its front to c (d_T > 0) and the
// faces cover every direction once. Given d_T > 0, the cover is the same for all directions, so
// one of them tells it: two nested spheres have all d_T > 0, but cover everything twice.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "chart/face_planes.h"
#include "rholm/error.h"
#include "rholm/star.h"
#include "shape/ray_scene.h"

namespace rholm {
namespace {

// d = n . (v - c): 2^-53 for each difference, 3 2^-53 for the product, about 6 2^-53 for the
// normal of a well-shaped triangle, all relative to |v - c|; below 16 2^-53 the sign means nothing.
constexpr double kDistanceRounding = 16 * 0x1p-53;

struct FaceFigures {
  double min_d = std::numeric_limits<double>::infinity();
  double min_cos_gamma = 1;
  std::size_t bad = 0;

  void merge(const FaceFigures& other) {
    min_d = std::min(min_d, other.min_d);
    min_cos_gamma = std::min(min_cos_gamma, other.min_cos_gamma);
    bad += other.bad;
  }
};

// Corners relative to the centre.
void add_face(const std::array<Vec3, 3>& corners, const Vec3& normal, FaceFigures& figures) {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0, d = 0;
  for (const Vec3& corner : corners) {
    const double distance = norm(corner);
    farthest = std::max(farthest, distance);
    if (distance < nearest) {
      nearest = distance;
      d = dot(normal, corner);
    }
  }
  figures.min_d = std::min(figures.min_d, d);
  figures.bad += d <= kDistanceRounding * nearest;
  // cos gamma = d / |v - c| is smallest on the farthest corner, or on the nearest if negative.
  const double distance = d > 0 ? farthest : nearest;
  figures.min_cos_gamma = std::min(figures.min_cos_gamma, distance > 0 ? d / distance : 0.0);
}

FaceFigures check_faces(const Mesh& mesh, const UnitFrame& frame, const Vec3& center,
                        const Context& context) {
  const std::size_t n = mesh.triangles.size(), grain = triangle_grain(n);
  std::vector<FaceFigures> parts((n + grain - 1) / grain);
  parallel_for(n, grain, context, {}, [&](std::size_t begin, std::size_t end) {
    FaceFigures& figures = parts[begin / grain];
    for (std::size_t t = begin; t < end; ++t) {
      std::array<Vec3, 3> corners = scaled_corners(mesh, mesh.triangles[t], frame.scale);
      const Vec3 normal = unit_normal(corners);
      if (normal == Vec3{}) continue;
      for (Vec3& corner : corners) corner -= frame.scale * center;
      add_face(corners, normal, figures);
    }
  });
  FaceFigures total;
  for (const FaceFigures& part : parts) total.merge(part);
  return total;
}

// 1 if the direction lies inside the triangle's cone, 0 if outside, -1 if rounding hides it.
int cone_contains(const std::array<Vec3, 3>& corners, const Vec3& direction) {
  bool unclear = false;
  for (int k = 0; k < 3; ++k) {
    const Vec3& a = corners[k];
    const Vec3& b = corners[k == 2 ? 0 : k + 1];
    const double side = dot(cross(a, b), direction);
    // Six products of three factors: below 8 2^-53 of the lengths.
    const double rounding = 8 * 0x1p-53 * norm(a) * norm(b);
    if (side < -rounding) return 0;
    unclear = unclear || side <= rounding;
  }
  return unclear ? -1 : 1;
}

// How often the faces, all with d_T > 0, cover the direction; -1 if it meets an edge.
long long cover_of(const Mesh& mesh, const UnitFrame& frame, const Vec3& center,
                   const Vec3& direction) {
  long long cover = 0;
  for (const Triangle& t : mesh.triangles) {
    std::array<Vec3, 3> corners = scaled_corners(mesh, t, frame.scale);
    if (unit_normal(corners) == Vec3{}) continue;
    for (Vec3& corner : corners) corner -= frame.scale * center;
    const int contains = cone_contains(corners, direction);
    if (contains < 0) return -1;
    cover += contains;
  }
  return cover;
}

// Direction i of n, spread evenly: a Fibonacci lattice.
Vec3 lattice_direction(std::size_t i, std::size_t n) {
  const double z = 1 - (2.0 * static_cast<double>(i) + 1) / static_cast<double>(n);
  const double turns = static_cast<double>(i) * (std::numbers::phi - 1);
  const double phi = 2 * std::numbers::pi * (turns - std::floor(turns));
  const double s = std::sqrt(std::max(0.0, 1 - z * z));
  return {s * std::cos(phi), s * std::sin(phi), z};
}

bool covers_once(const Mesh& mesh, const UnitFrame& frame, const Vec3& center) {
  // Eight directions in general position (chosen): all of them on edges would be a coincidence
  // that only a mesh finer than rounding brings about.
  for (std::size_t i = 0; i < 8; ++i) {
    const long long cover = cover_of(mesh, frame, center, lattice_direction(i, 8));
    if (cover >= 0) return cover == 1;
  }
  return false;
}

struct RayCounts {
  std::size_t once = 0;
  std::size_t multiple = 0;
};

void shoot_rays(const Mesh& mesh, const UnitFrame& frame, const Vec3& center,
                const Context& context, StarReport& report) {
  Mesh local;  // Embree works in single precision: give it coordinates near 1
  local.triangles = mesh.triangles;
  local.vertices.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) local.vertices.push_back(frame.to_local(v));
  const RayScene scene(local);
  const Vec3 origin = frame.to_local(center);
  const auto n = static_cast<std::size_t>(report.rays);
  constexpr std::size_t kGrain = 1024;  // chosen: about a millisecond
  std::vector<RayCounts> parts((n + kGrain - 1) / kGrain);
  parallel_for(n, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int hits = scene.count_hits(origin, lattice_direction(i, n));
      parts[begin / kGrain].once += hits == 1;
      parts[begin / kGrain].multiple += hits > 1;
    }
  });
  RayCounts total;
  for (const RayCounts& part : parts) {
    total.once += part.once;
    total.multiple += part.multiple;
  }
  const double all = report.rays;
  report.once_share = static_cast<double>(total.once) / all;
  report.multiple_share = static_cast<double>(total.multiple) / all;
  report.missed_share = static_cast<double>(n - total.once - total.multiple) / all;
}

// From farther away the shape is a point to double precision, and its middle to a ray.
void require_center_near(const UnitFrame& frame, const Vec3& center) {
  constexpr double kFarthest = 1e15;  // sizes of the shape
  if (is_finite(center) && norm(1e-150 * frame.to_local(center)) < 1e-150 * kFarthest) return;
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("the centre ({:.9g}, {:.9g}, {:.9g}) is not a point within {:g} sizes of "
                          "the shape",
                          center.x, center.y, center.z, kFarthest));
}

}  // namespace

StarReport check_star(const Mesh& mesh, const Vec3& center, int rays, const Context& context) {
  validate(mesh);
  const UnitFrame frame = unit_frame(bounds(mesh.vertices));
  require_center_near(frame, center);
  const FaceFigures figures = check_faces(mesh, frame, center, context);
  StarReport report;
  report.center = center;
  report.min_d = figures.min_d / frame.scale;
  report.min_cos_gamma = figures.min_cos_gamma;
  report.bad_triangles = figures.bad;
  report.star_shaped = figures.bad == 0 && covers_once(mesh, frame, center);
  report.rays = std::max(0, rays);
  if (report.rays > 0) shoot_rays(mesh, frame, center, context, report);
  return report;
}

}  // namespace rholm
