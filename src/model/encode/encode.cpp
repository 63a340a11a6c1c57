#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "base/stopwatch.h"
#include "model/encode/as_it_lies.h"
#include "model/encode/by_chart.h"
#include "rholm/error.h"
#include "rholm/mapped_mesh.h"
#include "rholm/model.h"
#include "rholm/shape_io.h"

namespace rholm {
namespace {

std::variant<Encoded, NotAsItLies> encode_in_file(const MappedMesh& mesh,
                                                  const EncodeOptions& options,
                                                  const Context& context) {
  MeshPassOptions hooks;
  hooks.check = [&](std::size_t first, std::size_t n) { return mesh.counts_are_three(first, n); };
  hooks.release = [&](std::size_t first, std::size_t n) { mesh.release(first, n); };
  return encode_as_it_lies(mesh.view(), options, hooks, context);
}

}  // namespace

std::optional<Encoded> encode_mapped(const MappedMesh& mesh, const EncodeOptions& options,
                                     const Context& context) {
  auto result = encode_in_file(mesh, options, context);
  if (Encoded* encoded = std::get_if<Encoded>(&result)) return std::move(*encoded);
  return std::nullopt;
}

Encoded encode_file(const std::filesystem::path& path, const EncodeOptions& options,
                    const Context& context, const std::function<Mesh()>& read) {
  StageTimes times;
  const auto with_times = [&](Encoded encoded) {
    encoded.times.merge(times);
    return encoded;
  };
  // What the reader hands on of faces that no pass can use, a pass may be able to use.
  bool as_it_lies = true;
  if (const auto mapped = timed(times, "read", [&] { return map_mesh(path, context); })) {
    auto result = encode_in_file(*mapped, options, context);
    if (Encoded* encoded = std::get_if<Encoded>(&result)) return with_times(std::move(*encoded));
    as_it_lies = std::get<NotAsItLies>(result) == NotAsItLies::kUnusable;
  }
  const Mesh mesh = timed(times, "read", read);
  if (as_it_lies) return with_times(encode(mesh, options, context));
  validate(mesh);
  return with_times(encode_by_chart(mesh, options, context));
}

Encoded encode_file(const std::filesystem::path& path, const EncodeOptions& options,
                    const Context& context, std::vector<std::string>* warnings) {
  const std::function<Mesh()> read = [&] {
    ShapeFile file = read_shape(path, {}, context);
    if (warnings != nullptr) {
      warnings->insert(warnings->end(), file.warnings.begin(), file.warnings.end());
    }
    if (Mesh* mesh = std::get_if<Mesh>(&file.shape)) return std::move(*mesh);
    throw Error(ErrorCode::kInvalidInput, path.string() + " holds points, not a mesh");
  };
  return encode_file(path, options, context, read);
}

Encoded encode(const Mesh& mesh, const EncodeOptions& options, const Context& context) {
  validate(mesh);
  auto result = encode_as_it_lies(view_of(mesh), options, {}, context);
  if (Encoded* encoded = std::get_if<Encoded>(&result)) return std::move(*encoded);
  return encode_by_chart(mesh, options, context);
}

Encoded encode(const MeshView& mesh, const EncodeOptions& options, const Context& context) {
  validate(mesh);
  auto result = encode_as_it_lies(mesh, options, {}, context);
  if (Encoded* encoded = std::get_if<Encoded>(&result)) return std::move(*encoded);
  return encode_by_chart(mesh_of(mesh), options, context);
}

}  // namespace rholm
