#include "io/ply/mapped_polygons.h"

#include "named_bytes.h"

namespace rholm::fuzzing {
namespace {

// Checks that a mapped file shows the same triangles and vertices as the reader of whole files.
void check(std::span<const char> bytes) {
  const NamedBytes file(bytes);
  std::optional<MappedPolygons> polygons;
  try {
    polygons = map_polygons(file.name(), {});
  } catch (const Error&) {
    return;
  }
  if (!polygons) return;
  std::vector<Triangle> triangles;
  polygons->visit([&](const Triangle& t) { triangles.push_back(t); });
  require(triangles.size() == polygons->n_triangles());
  ShapeFile whole;
  try {
    whole = parse_shape(bytes, file.name());
  } catch (const Error&) {
    return;  // coordinates that are not finite
  }
  const auto& mesh = std::get<Mesh>(whole.shape);
  require(mesh.faces == triangles);
  const MeshView& view = polygons->vertices().view();
  require(view.n_vertices == mesh.vertices.size());
  for (std::size_t i = 0; i < view.n_vertices; ++i) require(view.vertex(i) == mesh.vertices[i]);
}

}  // namespace
}  // namespace rholm::fuzzing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rholm::fuzzing::check({reinterpret_cast<const char*>(data), size});
  return 0;
}
