#include "rholm/large_mesh.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "io/ply/mapped_polygons.h"
#include "io/shapes/face_list.h"
#include "io/shapes/shape_source.h"
#include "io/shapes/shape_writers.h"
#include "rholm/error.h"
#include "shape/face.h"
#include "shape/measure.h"
#include "shape/topology/closed.h"
#include "shape/vertex_range.h"

namespace rholm {
namespace {

[[noreturn]] void refuse_face() {
  throw Error(ErrorCode::kInvalidInput, "a face is not a triangle");
}

PointRange vertices_of(const MappedMesh& mesh) {
  return PointRange(
      mesh.view(), [&mesh](std::size_t first, std::size_t n) { release_vertices(mesh, first, n); });
}

std::vector<std::string> write_mapped(const MappedMesh& mesh, const TriangleRange& triangles,
                                      const std::filesystem::path& path,
                                      const ShapeWriteOptions& options, const Context& context) {
  const ShapeView shape{.points = vertices_of(mesh),
                        .normals = {},
                        .faces = triangles,
                        .attributes = {mesh.scalars().begin(), mesh.scalars().end()},
                        .is_mesh = true};
  shape.points.visit([&](std::size_t, const Vec3& p) {
    if (!is_finite(p)) validate(mesh.view());  // throws, and names the vertex
  });
  return write_view(shape, path, options, context);
}

}  // namespace

bool has_attributes(const MappedMesh& mesh) { return !mesh.scalars().empty(); }

std::vector<Attribute> described_attributes(const MappedMesh& mesh) {
  std::vector<Attribute> attributes;
  for (const MappedScalar& scalar : mesh.scalars()) {
    attributes.push_back({.name = scalar.name, .type = scalar.type});
  }
  return attributes;
}

std::vector<std::string> attribute_warnings(const MappedMesh& mesh) {
  std::vector<ScalarRange> floats;
  for (const MappedScalar& scalar : mesh.scalars()) {
    const bool is_float =
        scalar.type == ScalarType::kFloat32 || scalar.type == ScalarType::kFloat64;
    if (is_float) floats.emplace_back(scalar);
  }
  std::vector<std::size_t> not_finite(floats.size());
  if (!floats.empty()) {
    vertices_of(mesh).visit_numbers([&](std::size_t i) {
      for (std::size_t k = 0; k < floats.size(); ++k) not_finite[k] += !std::isfinite(floats[k][i]);
    });
  }
  std::vector<std::string> warnings;
  for (std::size_t k = 0; k < floats.size(); ++k) {
    if (not_finite[k] > 0) warnings.push_back(not_finite_warning(floats[k].name, not_finite[k]));
  }
  return warnings;
}

bool has_triangles_only(const MappedMesh& mesh, const Context& context) {
  constexpr std::size_t kFaces = std::size_t{1} << 20;  // chosen: 13 MB
  const std::size_t all = mesh.view().n_faces;
  for (std::size_t first = 0; first < all; first += kFaces) {
    const std::size_t n = std::min(kFaces, all - first);
    report_progress(context, "faces", static_cast<double>(first) / static_cast<double>(all));
    if (!mesh.counts_are_three(first, n)) return false;
    mesh.release(first, n);
  }
  return true;
}

MeshInPlace in_place(const MappedMesh& mesh) {
  return {.mesh = mesh.view(),
          .release_vertices = [&mesh](std::size_t first,
                                      std::size_t n) { release_vertices(mesh, first, n); },
          .release_faces = [&mesh](std::size_t first, std::size_t n) { mesh.release(first, n); }};
}

std::vector<std::string> write_shape(const MappedMesh& mesh, const std::filesystem::path& path,
                                     const ShapeWriteOptions& options, const Context& context) {
  if (!has_triangles_only(mesh, context)) refuse_face();
  const MeshView& view = mesh.view();
  const TriangleRange triangles(view,
                                [&](std::size_t first, std::size_t n) { mesh.release(first, n); });
  triangles.visit([&](std::size_t, const Triangle& t) {  // as validate(), in blocks
    if (std::max({t[0], t[1], t[2]}) >= view.n_vertices) validate(view);
  });
  return write_mapped(mesh, triangles, path, options, context);
}

std::optional<ConvertedMesh> convert_mesh(const std::filesystem::path& from,
                                          const std::filesystem::path& to,
                                          const ShapeWriteOptions& options,
                                          const Context& context) {
  if (const auto mesh = map_mesh(from, context); mesh && has_triangles_only(*mesh, context)) {
    std::vector<std::string> written = write_shape(*mesh, to, options, context);
    return ConvertedMesh{described_attributes(*mesh), attribute_warnings(*mesh),
                         std::move(written)};
  }
  const std::optional<MappedPolygons> polygons = map_polygons(from, context);
  if (!polygons) return {};
  const MappedMesh& mesh = polygons->vertices();
  const TriangleRange triangles(polygons->n_triangles(),
                                [&](const auto& visit) { polygons->visit(visit); });
  std::vector<std::string> written = write_mapped(mesh, triangles, to, options, context);
  ConvertedMesh converted{described_attributes(mesh), attribute_warnings(mesh), std::move(written)};
  if (polygons->skipped() > 0) {
    converted.warnings.insert(converted.warnings.begin(), skipped_warning(polygons->skipped()));
  }
  return converted;
}

MeshSurvey survey_mesh(const MappedMesh& mesh, const Context& context) {
  const MeshView& view = mesh.view();
  if (!has_triangles_only(mesh, context)) refuse_face();
  const VertexRange range = vertex_range(view, context);
  std::uint32_t largest = 0;
  for (std::size_t t = 0; t < view.n_faces; ++t) {
    const Triangle corners = view.triangle(t);
    largest = std::max({largest, corners[0], corners[1], corners[2]});
  }
  if (!range.finite || largest >= view.n_vertices) validate(view);  // throws and says where
  MeshSurvey survey;
  survey.bounds = {.min = {range.min[0], range.min[1], range.min[2]},
                   .max = {range.max[0], range.max[1], range.max[2]}};
  const UnitFrame frame = unit_frame(survey.bounds);
  const Sizes sizes = measure_sizes(view, frame, context);
  survey.area = sizes.area;
  survey.volume = sizes.volume;
  survey.closed = is_closed(view);
  survey.volume_centroid = volume_centroid(view, frame, context);
  return survey;
}

}  // namespace rholm
