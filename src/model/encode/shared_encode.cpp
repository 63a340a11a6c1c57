#include "model/encode/shared_encode.h"

#include <utility>
#include <variant>

#include "base/bytes.h"
#include "base/stopwatch.h"
#include "model/encode/as_it_lies.h"
#include "model/encode/by_chart.h"
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

Encoded or_throw(std::variant<Encoded, NotAsItLies> result, const Mesh& mesh,
                 const EncodeOptions& options, const Context& context) {
  if (Encoded* encoded = std::get_if<Encoded>(&result)) return std::move(*encoded);
  return encode_by_chart(mesh, options, context);
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

Encoded encode_file(const std::filesystem::path& path, const EncodeOptions& options,
                    const Context& context, const std::function<Mesh()>& read,
                    const ShareOfMesh& share) {
  StageTimes times;
  const auto with_times = [&](Encoded encoded) {
    encoded.times.merge(times);
    return encoded;
  };
  const auto shared = [&](MeshPassOptions hooks, Place place, const MeshView& mesh) {
    if (share) hooks.share = share(bytes_of(place, path, mesh));
    return hooks;
  };
  // What the reader hands on of faces that no pass can use, a pass may be able to use.
  bool as_it_lies = true;
  if (const auto mapped = timed(times, "read", [&] { return map_mesh(path, context); })) {
    const MeshPassOptions hooks = shared(hooks_of(*mapped), Place::kMapped, mapped->view());
    auto result = encode_as_it_lies(mapped->view(), options, hooks, context);
    if (Encoded* encoded = std::get_if<Encoded>(&result)) return with_times(std::move(*encoded));
    as_it_lies = std::get<NotAsItLies>(result) == NotAsItLies::kUnusable;
  }
  const Mesh mesh = timed(times, "read", read);
  validate(mesh);
  if (!as_it_lies) return with_times(encode_by_chart(mesh, options, context));
  const MeshView view = view_of(mesh);
  return with_times(
      or_throw(encode_as_it_lies(view, options, shared({}, Place::kRead, view), context), mesh,
               options, context));
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

DoSharedTask SharedMesh::tasks_of(std::string_view job) {
  if (job.starts_with(kPassTag)) return helper_->tasks_of(job.substr(1));
  if (job.starts_with(kNormsTag)) return norms_tasks(view_, job.substr(1));
  ByteReader::refuse();
}

}  // namespace rholm
