#include "model/expand/expand_file.h"

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/bytes.h"
#include "base/stopwatch.h"
#include "model/expand/expand.h"
#include "rholm/error.h"
#include "rholm/large_mesh.h"
#include "rholm/shape_io.h"
#include "shape/fingerprint.h"
#include "transform/norms/exact_norms.h"

namespace rholm {
namespace {

enum class Place : std::uint32_t { kMapped, kRead };

std::string bytes_of(Place place, const std::filesystem::path& path, const MeshView& mesh) {
  ByteWriter writer;
  writer.value(place);
  writer.text(path.string());
  writer.value(fingerprint(mesh));
  return writer.take();
}

// Continues with a mesh that cannot be expanded in place.
Expanded expand_prepared(const Mesh& mesh, const ExpandOptions& options, const Context& context) {
  StageTimes times;
  report_progress(context, "topology", 0);
  PreparedMesh prepared =
      timed(times, "topology", [&] { return prepare(mesh, options.weld_tolerance); });
  Expanded expanded = expand(prepared, options, context);
  expanded.times.merge(times);
  expanded.diagonal = bounds(mesh.vertices).diagonal();
  expanded.merged_vertices = prepared.shape.welded.merged_vertices;
  expanded.collapsed_faces = prepared.shape.welded.collapsed_faces;
  expanded.flipped = prepared.shape.flipped;
  return expanded;
}

}  // namespace

MeshPassOptions hooks_of(const MappedMesh& mesh) {
  MeshPassOptions hooks;
  hooks.check = [&](std::size_t first, std::size_t n) { return mesh.counts_are_three(first, n); };
  hooks.release = [&](std::size_t first, std::size_t n) { mesh.release(first, n); };
  hooks.release_vertices = [&](std::size_t first, std::size_t n) {
    release_vertices(mesh, first, n);
  };
  return hooks;
}

Expanded expand_file(const std::filesystem::path& path, const ExpandOptions& options,
                     const Context& context, const std::function<Mesh()>& read,
                     const ExecutorOfMesh& executor_of) {
  StageTimes times;
  const auto in_place = [&](MeshPassOptions hooks, Place place, const MeshView& mesh) {
    const std::unique_ptr<Executor> executor =
        executor_of ? executor_of(bytes_of(place, path, mesh)) : nullptr;
    hooks.executor = executor.get();
    return expand_in_place(mesh, options, hooks, context);
  };
  // The reader may change faces that no pass can use so that a pass can use them.
  std::variant<Expanded, NotInPlace> result = NotInPlace::kUnusable;
  if (const auto mapped = timed(times, "read", [&] { return map_mesh(path, context); })) {
    result = in_place(hooks_of(*mapped), Place::kMapped, mapped->view());
  }
  if (!std::holds_alternative<Expanded>(result)) {
    const Mesh mesh = timed(times, "read", read);
    validate(mesh);
    if (std::get<NotInPlace>(result) == NotInPlace::kUnusable) {
      result = in_place({}, Place::kRead, view_of(mesh));
    }
    if (!std::holds_alternative<Expanded>(result)) result = expand_prepared(mesh, options, context);
  }
  Expanded& expanded = std::get<Expanded>(result);
  expanded.times.merge(times);
  return std::move(expanded);
}

SharedMesh::SharedMesh(std::string_view mesh, const Context& context) {
  ByteReader reader(mesh);
  Place place = {};
  reader.value(place);
  const std::filesystem::path path(reader.text());
  std::uint64_t expected = 0;
  reader.value(expected);
  reader.finish();
  if (place == Place::kMapped) mapped_ = map_mesh(path, context);
  if (mapped_) {
    view_ = mapped_->view();
    hooks_ = hooks_of(*mapped_);
  } else {
    ShapeFile file = read_shape(path, {}, context);
    if (Mesh* found = std::get_if<Mesh>(&file.shape)) mesh_ = std::move(*found);
    view_ = view_of(mesh_);
    validate(view_);
  }
  if (fingerprint(view_) != expected) {
    throw Error(ErrorCode::kInvalidInput,
                path.string() + " is not the file of that name that the first process has");
  }
  helper_.emplace(view_, hooks_);
}

Executor::Work SharedMesh::work_of(std::string_view job, std::string_view input) {
  if (job == kPassJob) return helper_->work_of(input);
  if (job == kNormsJob) return norms_work(view_, input);
  ByteReader::refuse();
}

std::optional<Expanded> expand_mapped(const MappedMesh& mesh, const ExpandOptions& options,
                                      const Context& context) {
  auto result = expand_in_place(mesh.view(), options, hooks_of(mesh), context);
  if (Expanded* expanded = std::get_if<Expanded>(&result)) return std::move(*expanded);
  return std::nullopt;
}

Expanded expand_file(const std::filesystem::path& path, const ExpandOptions& options,
                     const Context& context, const std::function<Mesh()>& read) {
  return expand_file(path, options, context, read, {});
}

Expanded expand_file(const std::filesystem::path& path, const ExpandOptions& options,
                     const Context& context, std::vector<std::string>* warnings) {
  const std::function<Mesh()> read = [&] {
    ShapeFile file = read_shape(path, {}, context);
    if (warnings != nullptr) {
      warnings->insert(warnings->end(), file.warnings.begin(), file.warnings.end());
    }
    if (Mesh* mesh = std::get_if<Mesh>(&file.shape)) return std::move(*mesh);
    throw Error(ErrorCode::kInvalidInput,
                path.string() + " holds points, not a mesh; reconstruct() makes one");
  };
  return expand_file(path, options, context, read);
}

Expanded expand(const Mesh& mesh, const ExpandOptions& options, const Context& context) {
  validate(mesh);
  auto result = expand_in_place(view_of(mesh), options, {}, context);
  if (Expanded* expanded = std::get_if<Expanded>(&result)) return std::move(*expanded);
  return expand_prepared(mesh, options, context);
}

Expanded expand(const MeshView& mesh, const ExpandOptions& options, const Context& context) {
  validate(mesh);
  auto result = expand_in_place(mesh, options, {}, context);
  if (Expanded* expanded = std::get_if<Expanded>(&result)) return std::move(*expanded);
  return expand_prepared(mesh_of(mesh), options, context);
}

}  // namespace rholm
