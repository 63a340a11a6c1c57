#include "report/picture/view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/cancel.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Distance of the eye in radii of the scene. Chosen: at 4 the scene
// fills 29 degrees, the angle of a picture viewed at arm's length.
constexpr double kEyeDistance = 4;

Vec3 unit_direction(const Vec3& v, const char* what) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!is_finite(v) || !(largest > 0)) {
    throw Error(ErrorCode::kInvalidInput,
                std::string(what) + " must be a finite vector other than 0");
  }
  return normalized(v / largest);
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr PlaneBox kEmptyBox{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};

void extend(PlaneBox& box, const PlanePoint& p) {
  box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y)};
  box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y)};
}

// Returns any unit vector across `axis`.
Vec3 across(const Vec3& axis) {
  const Vec3 other = std::abs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return normalized(cross(axis, other));
}

}  // namespace

View make_view(const RenderOptions& options, double radius) {
  View view;
  view.forward = unit_direction(options.view, "the view direction");
  const Vec3 side = cross(view.forward, unit_direction(options.up, "the upward direction"));
  // Along `up` no upright picture exists, so any will do. 1e-9 is far above rounding.
  view.right = norm(side) > 1e-9 ? normalized(side) : across(view.forward);
  view.up = cross(view.right, view.forward);
  view.distance = kEyeDistance * radius;
  view.perspective = options.perspective;
  return view;
}

PlanePoint View::project(const Vec3& p) const {
  const double shrink = perspective ? distance / (distance + dot(p, forward)) : 1;
  return {shrink * dot(p, right), shrink * dot(p, up)};
}

PlaneBox projected_box(const View& view, const Mesh& mesh) {
  if (mesh.faces.empty()) return {};
  std::vector<bool> is_corner(mesh.vertices.size());
  CancelPoll poll;
  for (const Triangle& t : mesh.faces) {
    poll();
    for (const std::uint32_t corner : t) is_corner[corner] = true;
  }
  PlaneBox box = kEmptyBox;
  for (std::size_t k = 0; k < is_corner.size(); ++k) {
    if (is_corner[k]) extend(box, view.project(mesh.vertices[k]));
  }
  return box;
}

PlaneBox projected_box(const View& view, std::span<const Vec3> points, double ball_radius) {
  if (points.empty()) return {};
  PlaneBox box = kEmptyBox;
  CancelPoll poll;
  for (const Vec3& p : points) {
    poll();
    // The eye sees the tangent cone: a ball in front of it appears r / sqrt(1 - (r/d)^2) wide.
    const double part = view.perspective ? ball_radius / (view.distance + dot(p, view.forward)) : 0;
    const double radius = ball_radius / std::sqrt(1 - part * part);
    for (const Vec3& side : {radius * view.right, radius * view.up}) {
      extend(box, view.project(p - side));
      extend(box, view.project(p + side));
    }
  }
  return box;
}

}  // namespace rholm
