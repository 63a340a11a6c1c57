#include "chart/face_planes.h"

#include <algorithm>
#include <string>

#include "base/parallel.h"
#include "rholm/error.h"

namespace rholm {

std::size_t triangle_grain(std::size_t n_triangles) {
  return std::max<std::size_t>(256, n_triangles / 256);
}

Vec3 unit_normal(const std::array<Vec3, 3>& corners) {
  const FaceNormal face = face_normal(corners);
  return face.degenerate ? Vec3{} : normalized(face.twice_area);
}

FacePlanes face_planes(const Mesh& mesh, const Context& context) {
  validate(mesh);
  FacePlanes result;
  result.frame = unit_frame(bounds(mesh.vertices));
  result.planes.resize(mesh.triangles.size());
  const auto fill = [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto corners = scaled_corners(mesh, mesh.triangles[t], result.frame.scale);
      const Vec3 normal = unit_normal(corners);
      result.planes[t] = {.normal = normal,
                          .offset = dot(normal, corners[0] - result.frame.center)};
    }
  };
  parallel_for(mesh.triangles.size(), triangle_grain(mesh.triangles.size()), context, {}, fill);
  if (std::none_of(result.planes.begin(), result.planes.end(),
                   [](const FacePlane& plane) { return plane.exists(); })) {
    throw Error(ErrorCode::kInvalidInput, "none of the mesh's " +
                                              std::to_string(mesh.triangles.size()) +
                                              " triangles has an area above zero: there is no "
                                              "surface to look at from a centre");
  }
  return result;
}

}  // namespace rholm
