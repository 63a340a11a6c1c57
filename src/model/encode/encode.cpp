#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "model/encode/as_it_lies.h"
#include "model/encode/by_chart.h"
#include "model/encode/shared_encode.h"
#include "rholm/error.h"
#include "rholm/mapped_mesh.h"
#include "rholm/model.h"
#include "rholm/shape_io.h"

namespace rholm {
std::optional<Encoded> encode_mapped(const MappedMesh& mesh, const EncodeOptions& options,
                                     const Context& context) {
  auto result = encode_as_it_lies(mesh.view(), options, hooks_of(mesh), context);
  if (Encoded* encoded = std::get_if<Encoded>(&result)) return std::move(*encoded);
  return std::nullopt;
}

Encoded encode_file(const std::filesystem::path& path, const EncodeOptions& options,
                    const Context& context, const std::function<Mesh()>& read) {
  return encode_file(path, options, context, read, {});
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
