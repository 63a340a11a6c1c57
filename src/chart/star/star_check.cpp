// Checks whether a surface is star-shaped from a given centre. Source: method 6.
//
// A closed mesh is star-shaped from c if every face is front-facing (d_T > 0) and the faces cover
// every direction once. The number of front faces minus the number of back faces that a direction
// meets is the same for all directions, so one direction is enough. For example, two nested spheres
// have all d_T > 0, but cover everything twice. Faces thinner than the rounding of their
// coordinates may be back-facing, although the exact surface is not.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "chart/center/view_center.h"
#include "chart/center/view_scan.h"
#include "chart/star/cone.h"
#include "chart/star/direction_counts.h"
#include "rholm/error.h"
#include "shape/queries/ray_scene.h"

namespace rholm {
namespace {

// Relative rounding of d = n . (v - c): 2^-53 for each difference, 3 2^-53 for the product, about 6
// 2^-53 for the normal of a well-shaped triangle, all relative to |v - c|. Below 16 2^-53 the sign
// is meaningless.
constexpr double kDistanceRounding = 16 * 0x1p-53;

struct FaceFigures {
  double min_d = std::numeric_limits<double>::infinity();
  double min_cos_gamma = 1;
  std::size_t bad = 0;
  std::vector<std::uint32_t> low;  // see count_meetings()

  void merge(const FaceFigures& other) {
    min_d = std::min(min_d, other.min_d);
    min_cos_gamma = std::min(min_cos_gamma, other.min_cos_gamma);
    bad += other.bad;
    low.insert(low.end(), other.low.begin(), other.low.end());
  }
};

// Adds a face, given by its corners relative to the centre, with the largest d_T that the rounding
// of the corners allows.
void add_face(const std::array<Vec3, 3>& corners, const FacePlane& face, FaceFigures& figures) {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0, d = 0;
  for (const Vec3& corner : corners) {
    const double distance = norm(corner);
    farthest = std::max(farthest, distance);
    if (distance < nearest) {
      nearest = distance;
      d = dot(face.normal, corner) + face.slack() * distance;
    }
  }
  figures.min_d = std::min(figures.min_d, d);
  figures.bad += d <= kDistanceRounding * nearest;
  // cos gamma = d / |v - c| is smallest at the farthest corner if d > 0, at the nearest otherwise.
  const double distance = d > 0 ? farthest : nearest;
  figures.min_cos_gamma = std::min(figures.min_cos_gamma, distance > 0 ? d / distance : 0.0);
}

FaceFigures check_faces(const LocalView& view, const Vec3& center, const Context& context) {
  const std::size_t n = view.mesh.n_faces, grain = triangle_grain(n);
  const Vec3 local = view.frame.to_local(center);
  // Bound of d_T below which rounding may hide the sign, from any corner of the unit frame, with a
  // factor of 2 as margin. It is at least kNearPlane, the bound that count_meetings() needs.
  const double unclear = std::max(2 * kDistanceRounding * (norm(local) + 2), kNearPlane);
  std::vector<FaceFigures> parts((n + grain - 1) / grain);
  parallel_for(n, grain, context, {}, [&](std::size_t begin, std::size_t end) {
    FaceFigures& figures = parts[begin / grain];
    ScanLimits limits{.distance = figures.min_d, .cosine = figures.min_cos_gamma};
    scan_below(view, begin, end, local, limits, [&](std::size_t triangle) {
      // A face above the bound is added too if the scan visits it before a lower face.
      figures.low.push_back(static_cast<std::uint32_t>(triangle));
      const FacePlane face = view.plane(triangle);
      if (!face.exists()) return;
      add_face(corners_from(view, triangle, center), face, figures);
      limits = {.distance = std::max(figures.min_d, unclear), .cosine = figures.min_cos_gamma};
    });
  });
  FaceFigures total;
  for (const FaceFigures& part : parts) total.merge(part);
  return total;
}

// Returns a copy of the mesh with coordinates near 1, because Embree works in single precision.
Mesh local_copy(const LocalView& view) {
  Mesh local;
  local.vertices.reserve(view.mesh.n_vertices);
  for (std::size_t i = 0; i < view.mesh.n_vertices; ++i) {
    local.vertices.push_back(view.frame.to_local(view.mesh.vertex(i)));
  }
  local.faces.reserve(view.mesh.n_faces);
  for (std::size_t t = 0; t < view.mesh.n_faces; ++t) {
    local.faces.push_back(view.mesh.triangle(t));
  }
  return local;
}

// Counts crossings by rays, for surfaces that are not closed.
std::vector<int> shoot_rays(const LocalView& view, const Vec3& center, std::size_t n,
                            const Context& context) {
  const Mesh local = local_copy(view);  // the scene refers to it
  const RayScene scene(local, context);
  const Vec3 origin = view.frame.to_local(center);
  std::vector<int> hits(n);
  constexpr std::size_t kGrain = 1024;  // chosen: about a millisecond
  parallel_for(n, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      hits[i] = scene.count_hits(origin, lattice_direction(i, n));
    }
  });
  return hits;
}

void try_directions(const LocalView& view, const Vec3& center,
                    const std::vector<std::uint32_t>& low, const Context& context,
                    StarReport& report) {
  const auto n = static_cast<std::size_t>(report.rays);
  std::optional<std::vector<int>> meetings;
  if (view.closed()) meetings = count_meetings(view, center, n, low, context);
  if (!meetings) meetings = shoot_rays(view, center, n, context);
  const auto share = [&](auto is_counted) {
    return static_cast<double>(std::ranges::count_if(*meetings, is_counted)) / report.rays;
  };
  report.once_share = share([](int times) { return times == 1; });
  report.multiple_share = share([](int times) { return times > 1; });
  report.missed_share = share([](int times) { return times < 1; });
}

// Farther away, the shape is a point in double precision, and a ray cannot aim at its middle.
void require_center_near(const UnitFrame& frame, const Vec3& center) {
  constexpr double kFarthest = 1e15;  // in sizes of the shape
  if (is_finite(center) && norm(1e-150 * frame.to_local(center)) < 1e-150 * kFarthest) return;
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("the centre ({:.9g}, {:.9g}, {:.9g}) is not a point within {:g} sizes of "
                          "the shape",
                          center.x, center.y, center.z, kFarthest));
}

}  // namespace

StarReport check_star(const LocalView& view, const Vec3& center, int rays, const Context& context) {
  require_center_near(view.frame, center);
  const FaceFigures figures = check_faces(view, center, context);
  StarReport report;
  report.center = center;
  report.min_d = figures.min_d / view.frame.scale;
  report.min_cos_gamma = figures.min_cos_gamma;
  report.bad_faces = figures.bad;
  report.star_shaped = figures.bad == 0 && surplus_of(view, center, context) == 1;
  report.rays = std::max(0, rays);
  if (report.rays > 0) try_directions(view, center, figures.low, context, report);
  return report;
}

StarReport check_star(const MeshView& mesh, const Vec3& center, int rays, const Context& context) {
  return check_star(local_view(mesh, context), center, rays, context);
}

StarReport check_star(const Mesh& mesh, const Vec3& center, int rays, const Context& context) {
  return check_star(view_of(mesh), center, rays, context);
}

}  // namespace rholm
