#include "chart/center/local_view.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "rholm/error.h"
#include "shape/topology/closed.h"
#include "shape/vertex_range.h"

namespace rholm {
namespace {

Bounds finite_bounds(const MeshView& mesh, const Context& context) {
  if (mesh.n_vertices == 0) return {};
  const VertexRange all = vertex_range(mesh, context);
  if (!all.finite) validate(mesh);  // throws with the index of the vertex
  return {.min = {all.min[0], all.min[1], all.min[2]}, .max = {all.max[0], all.max[1], all.max[2]}};
}

void require_surface(const LocalView& view) {
  for (std::size_t t = 0; t < view.mesh.n_faces; ++t) {
    if (view.plane(t).exists()) return;
  }
  throw Error(ErrorCode::kInvalidInput,
              "none of the mesh's " + std::to_string(view.mesh.n_faces) +
                  " faces has an area above zero, or is wider than the rounding of its "
                  "coordinates: there is no surface to look at from a centre");
}

}  // namespace

std::array<Vec3, 3> LocalView::corners(std::size_t triangle) const {
  const Triangle indices = mesh.triangle(triangle);
  if (std::max({indices[0], indices[1], indices[2]}) >= mesh.n_vertices) {
    validate(mesh);  // throws with the index
  }
  return scaled_corners(mesh, indices, frame.scale);
}

bool LocalView::closed() const {
  if (!known_closed) known_closed = is_closed(mesh);
  return *known_closed;
}

FacePlane LocalView::plane(std::size_t triangle) const {
  const std::array<Vec3, 3> scaled = corners(triangle);
  const FaceNormal face = face_normal(scaled);
  const PlaneUncertainty uncertainty = plane_uncertainty(scaled, face, error);
  if (uncertainty.thin) return {};
  const Vec3 normal = normalized(face.twice_area);
  return {
      .normal = normal, .offset = dot(normal, scaled[0] - frame.center), .turn = uncertainty.turn};
}

LocalView local_view(const MeshView& mesh, const Context& context) {
  LocalView view{.mesh = mesh, .frame = unit_frame(finite_bounds(mesh, context)), .error = {}};
  view.error = view.frame.scale * coordinate_error(mesh);
  require_surface(view);
  return view;
}

}  // namespace rholm
