#include "shape/measure.h"

#include <algorithm>
#include <cmath>

#include "base/cancel.h"
#include "base/compensated_sum.h"
#include "base/parallel.h"

namespace rholm {
namespace {

class VectorSum {
 public:
  void add(const Vec3& v) {
    x_.add(v.x);
    y_.add(v.y);
    z_.add(v.z);
  }
  Vec3 value() const { return {x_.value(), y_.value(), z_.value()}; }

 private:
  CompensatedSum x_, y_, z_;
};

constexpr std::size_t kGrain = 8192;  // chosen: some 100 us

}  // namespace

Sizes measure_sizes(const MeshView& mesh, const UnitFrame& frame, const Context& context) {
  struct Sums {
    CompensatedSum twice_area, six_volumes;
  };
  std::vector<Sums> parts((mesh.n_faces + kGrain - 1) / kGrain);
  parallel_for(mesh.n_faces, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    Sums part;
    for (std::size_t t = begin; t < end; ++t) {
      const std::array<Vec3, 3> corners = scaled_corners(mesh, mesh.triangle(t), frame.scale);
      const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
      part.twice_area.add(norm(normal));
      part.six_volumes.add(dot(normal, corners[0] - frame.center));
    }
    parts[begin / kGrain] = part;
  });
  CompensatedSum twice_area, six_volumes;
  for (const Sums& part : parts) {
    twice_area.add(part.twice_area.value());
    six_volumes.add(part.six_volumes.value());
  }
  return {.area = std::ldexp(0.5 * twice_area.value(), -2 * frame.exponent),
          .volume = std::ldexp(six_volumes.value() / 6, -3 * frame.exponent)};
}

Measures measure(const MeshView& mesh, const UnitFrame& frame) {
  CompensatedSum twice_area, six_volumes, moduli;
  VectorSum area_moment, volume_moment;
  CancelPoll poll;
  for (std::size_t t = 0; t < mesh.n_faces; ++t) {
    poll();
    const std::array<Vec3, 3> corners = scaled_corners(mesh, mesh.triangle(t), frame.scale);
    const Vec3 normal = face_normal(corners).twice_area;
    const Vec3 a = corners[0] - frame.center;
    const Vec3 sum = a + (corners[1] - frame.center) + (corners[2] - frame.center);
    const double length = norm(normal), volume = dot(normal, a);
    twice_area.add(length);
    area_moment.add(length * sum);
    six_volumes.add(volume);
    moduli.add(std::abs(volume));
    volume_moment.add(volume * sum);
  }
  Measures result;
  result.area = std::ldexp(0.5 * twice_area.value(), -2 * frame.exponent);
  result.volume = std::ldexp(six_volumes.value() / 6, -3 * frame.exponent);
  result.area_centroid = result.volume_centroid = frame.to_shape({});
  // A triangle's centroid is a third of the sum of its corners; a tetrahedron's is a quarter.
  if (twice_area.value() > 0) {
    result.area_centroid = frame.to_shape(area_moment.value() / (3 * twice_area.value()));
  }
  if (has_volume(six_volumes.value(), moduli.value())) {
    result.volume_centroid = frame.to_shape(volume_moment.value() / (4 * six_volumes.value()));
  }
  return result;
}

Bounds bounds(const std::vector<Vec3>& points) {
  if (points.empty()) return {};
  Bounds box{.min = points[0], .max = points[0]};
  for (const Vec3& p : points) {
    box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
    box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
  }
  return box;
}

std::vector<Vec3> area_normals(std::span<const Vec3> vertices,
                               std::span<const Triangle> triangles) {
  std::vector<Vec3> normals(vertices.size());
  CancelPoll poll;
  for (const Triangle& t : triangles) {
    poll();
    const Vec3& a = vertices[t[0]];
    const Vec3 area = cross(vertices[t[1]] - a, vertices[t[2]] - a);
    for (const std::uint32_t corner : t) normals[corner] += area;
  }
  return normals;
}

double surface_area(const Mesh& mesh) {
  return measure(view_of(mesh), unit_frame(bounds(mesh.vertices))).area;
}

double enclosed_volume(const Mesh& mesh) {
  return measure(view_of(mesh), unit_frame(bounds(mesh.vertices))).volume;
}

void flip(Mesh& mesh) {
  for (Triangle& t : mesh.faces) std::swap(t[1], t[2]);
  for (Attribute& attribute : mesh.attributes) {
    if (attribute.name != "nx" && attribute.name != "ny" && attribute.name != "nz") continue;
    for (double& value : attribute.values) value = -value;
  }
}

}  // namespace rholm
