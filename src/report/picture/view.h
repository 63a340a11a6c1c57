// View of a picture, and the position of points in it.
#pragma once

#include <span>

#include "rholm/mesh.h"
#include "rholm/render.h"
#include "shape/queries/ray_scene.h"

namespace rholm {

struct PlanePoint {
  double x = 0;  // distance to the right
  double y = 0;  // distance upwards
};

struct PlaneBox {
  PlanePoint min;
  PlanePoint max;
  double width() const { return max.x - min.x; }
  double height() const { return max.y - min.y; }
};

// The eye looks along `forward` at the origin; the picture plane goes through the origin.
struct View {
  Vec3 right;
  Vec3 up;
  Vec3 forward;
  double distance = 0;  // distance of the eye
  bool perspective = false;

  PlanePoint project(const Vec3& p) const;
  Ray ray(const PlanePoint& p) const {
    const Vec3 target = p.x * right + p.y * up;
    const Vec3 eye = -distance * forward;
    if (perspective) return {eye, normalized(target - eye)};
    return {target + eye, forward};
  }
};

// `radius`: of a ball about the origin that contains everything.
// Throws InvalidInput for a direction that is zero or not finite.
View make_view(const RenderOptions& options, double radius);

// Returns the box of all corners of triangles; a point at the origin without triangles.
PlaneBox projected_box(const View& view, const Mesh& mesh);
// Returns the box of balls of this radius about points.
PlaneBox projected_box(const View& view, std::span<const Vec3> points, double ball_radius);

}  // namespace rholm
