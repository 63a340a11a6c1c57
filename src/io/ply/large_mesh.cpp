#include "rholm/large_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"
#include "io/ply/mapped_rows.h"
#include "io/shapes/face_list.h"
#include "io/shapes/shape_source.h"
#include "io/shapes/shape_writers.h"
#include "rholm/context.h"
#include "rholm/error.h"
#include "rholm/mapped_mesh.h"
#include "rholm/mesh.h"
#include "rholm/polygon.h"
#include "shape/face.h"
#include "shape/measure.h"
#include "shape/topology/closed.h"
#include "shape/vertex_range.h"

namespace rholm {
namespace {

// A mesh in a binary PLY whose faces have any number of corners, where it lies.
class MappedPolygons {
 public:
  // Vertices, and no triangles.
  const MappedMesh& vertices() const { return vertices_; }
  std::size_t n_triangles() const { return n_triangles_; }
  std::size_t skipped() const { return skipped_; }  // faces with fewer than three corners

  // The triangles of all faces, as FaceList has them; what was visited is released.
  void visit(const std::function<void(const Triangle&)>& visit) const;

 private:
  friend std::optional<MappedPolygons> map_polygons(const std::filesystem::path&, const Context&);
  MappedPolygons(MappedMesh vertices, std::uint64_t n_faces)
      : vertices_(std::move(vertices)), n_faces_(n_faces) {}
  bool survey(std::size_t bytes);

  MappedMesh vertices_;
  std::uint64_t n_faces_;
  std::size_t n_triangles_ = 0, skipped_ = 0;
};

constexpr std::size_t kMostCorners = 255;  // the length is a byte

// The corners of a face.
struct Corners {
  std::array<std::uint32_t, kMostCorners> index;
  std::size_t n = 0;

  std::span<const std::uint32_t> all() const { return std::span(index).first(n); }
};

std::size_t bytes_of(std::size_t corners) { return 1 + 4 * corners; }

void take(const std::byte* face, Corners& corners) {
  corners.n = std::to_integer<std::size_t>(*face);
  std::memcpy(corners.index.data(), face + 1, 4 * corners.n);
}

// As FaceList: corners of polygons that are equal to the one before go.
void clean(Corners& corners) {
  if (corners.n <= 3) return;
  const auto begin = corners.index.begin();
  auto end = std::unique(begin, begin + static_cast<std::ptrdiff_t>(corners.n));
  while (end > begin + 1 && *(end - 1) == *begin) --end;
  corners.n = static_cast<std::size_t>(end - begin);
}

// Cuts polygons into triangles, with their corners alone.
class Cutter {
 public:
  explicit Cutter(const MeshView& mesh) : mesh_(mesh) {}

  void visit(const Corners& corners, const std::function<void(const Triangle&)>& visit) {
    places_.clear();
    numbers_.clear();
    triangles_.clear();
    for (const std::uint32_t corner : corners.all()) {
      numbers_.push_back(static_cast<std::uint32_t>(places_.size()));
      places_.push_back(mesh_.vertex(corner));
    }
    triangulate_polygon(places_, numbers_, triangles_);
    for (const auto& [a, b, c] : triangles_) {
      visit({corners.index[a], corners.index[b], corners.index[c]});
    }
  }

 private:
  const MeshView& mesh_;
  std::vector<Vec3> places_;
  std::vector<std::uint32_t> numbers_;
  std::vector<Triangle> triangles_;
};

// Tells what has been passed over in blocks.
class FaceRelease {
 public:
  explicit FaceRelease(const MappedMesh& mesh) : mesh_(mesh) {}
  void passed(std::size_t bytes) {
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    if (bytes - done_ < kBlock) return;
    mesh_.release(done_ / kFaceBytes, (bytes - done_) / kFaceBytes);
    done_ = bytes;
  }

 private:
  const MappedMesh& mesh_;
  std::size_t done_ = 0;
};

// Whether the faces fill the bytes, with indices in range.
bool MappedPolygons::survey(std::size_t bytes) {
  const MeshView& view = vertices_.view();
  const std::byte* const faces = view.triangles - 1;
  Corners corners;
  FaceRelease release(vertices_);
  CancelPoll poll;
  std::size_t at = 0;
  for (std::uint64_t face = 0; face < n_faces_; ++face) {
    poll();
    if (at == bytes) return false;
    const std::size_t size = bytes_of(std::to_integer<std::size_t>(faces[at]));
    if (size > bytes - at) return false;
    take(faces + at, corners);
    for (const std::uint32_t corner : corners.all()) {
      if (corner >= view.n_vertices) return false;
    }
    clean(corners);
    corners.n < 3 ? ++skipped_ : n_triangles_ += corners.n - 2;
    at += size;
    release.passed(at);
  }
  return at == bytes;
}

void MappedPolygons::visit(const std::function<void(const Triangle&)>& visit) const {
  const std::byte* const faces = vertices_.view().triangles - 1;
  Corners corners;
  Cutter cutter(vertices_.view());
  FaceRelease release(vertices_);
  std::size_t at = 0;
  for (std::uint64_t face = 0; face < n_faces_; ++face) {
    take(faces + at, corners);
    at += bytes_of(corners.n);
    clean(corners);
    if (corners.n == 3) {
      visit({corners.index[0], corners.index[1], corners.index[2]});
    } else if (corners.n > 3) {
      cutter.visit(corners, visit);
    }
    release.passed(at);
  }
}

// As map_mesh(), of faces with any number of corners; all of them are looked at, and a file with
// anything wrong in its faces is none.
std::optional<MappedPolygons> map_polygons(const std::filesystem::path& path,
                                           const Context& context) {
  std::optional<MappedRows> rows = map_rows(path, context);
  if (!rows) return {};
  MappedPolygons polygons(std::move(rows->mesh), rows->n_faces);
  if (!polygons.survey(rows->face_bytes)) return {};
  return polygons;
}

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
                        .triangles = triangles,
                        .attributes = {mesh.scalars().begin(), mesh.scalars().end()},
                        .is_mesh = true};
  shape.points.visit([&](std::size_t, const Vec3& p) {
    if (!is_finite(p)) validate(mesh.view());  // throws, and says which
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
  const std::size_t all = mesh.view().n_triangles;
  for (std::size_t first = 0; first < all; first += kFaces) {
    const std::size_t n = std::min(kFaces, all - first);
    report_progress(context, "faces", static_cast<double>(first) / static_cast<double>(all));
    if (!mesh.counts_are_three(first, n)) return false;
    mesh.release(first, n);
  }
  return true;
}

MeshInPlace in_place(const MappedMesh& mesh) {
  return {
      .mesh = mesh.view(),
      .release_vertices = [&mesh](std::size_t first,
                                  std::size_t n) { release_vertices(mesh, first, n); },
      .release_triangles = [&mesh](std::size_t first, std::size_t n) { mesh.release(first, n); }};
}

std::vector<std::string> write_shape(const MappedMesh& mesh, const std::filesystem::path& path,
                                     const ShapeWriteOptions& options, const Context& context) {
  if (!has_triangles_only(mesh, context)) refuse_face();
  const MeshView& view = mesh.view();
  const TriangleRange triangles(view,
                                [&](std::size_t first, std::size_t n) { mesh.release(first, n); });
  triangles.visit([&](std::size_t, const Triangle& t) {  // as validate(), a piece at a time
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
  for (std::size_t t = 0; t < view.n_triangles; ++t) {
    const Triangle corners = view.triangle(t);
    largest = std::max({largest, corners[0], corners[1], corners[2]});
  }
  if (!range.finite || largest >= view.n_vertices) validate(view);  // throws, and says which
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
