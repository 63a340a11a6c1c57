#include "reconstruct/output/tile_output.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "io/ply/ply_parts.h"
#include "reconstruct/output/carry_attributes.h"
#include "rholm/error.h"
#include "shape/points/sensors.h"

namespace rholm {
namespace {

// Returns the confidence of the signs of normals, which is 1 for given normals.
Attribute confidence_of(const TileScene& scene) {
  std::vector<double> sure(scene.points.size(), 1.0);
  for (std::size_t i = 0; i < scene.confidence.size(); ++i) {
    sure[scene.tree->order()[i]] = static_cast<double>(scene.confidence[i]);
  }
  return {"confidence", ScalarType::kFloat32, std::move(sure)};
}

}  // namespace

void TileOutput::write(const TileParts& parts, const TileParts::Whole& whole,
                       const std::filesystem::path& output) const {
  const PlyLayout layout(whole.vertices, whole.faces, attributes());
  std::optional<PlyParts> file;
  stages_.once("write", [&] {
    file.emplace(
        output, layout, stages_.context(),
        stages_.is_shared() ? AtomicFile::Writers::kSeveral : AtomicFile::Writers::kThisProcess);
    const std::string name = file->file().string();
    const std::span<const std::byte> sections[] = {std::as_bytes(std::span(name))};
    store_.write("output", sections);
  });
  const std::vector<char> name = store_.open("output").values<char>(0);
  const std::filesystem::path path(std::string(name.begin(), name.end()));
  const auto part = [&](std::size_t tile) {
    PlyPart made = parts.part(tile);
    carry(tile, made.vertices);
    return made;
  };
  if (!path.empty()) {
    stages_.each("write", n_tiles_,
                 [&](std::size_t tile) { PlyParts::put(path, layout, part(tile)); });
  }
  stages_.once("write", [&] {
    for (std::size_t tile = 0; path.empty() && tile < n_tiles_; ++tile) {
      file->append(ply_vertices(part(tile).vertices));
    }
    for (std::size_t tile = 0; path.empty() && tile < n_tiles_; ++tile) {
      file->append(ply_triangles(parts.part(tile).faces));
    }
    file->commit();
    store_.remove("output");
  });
}

Mesh TileOutput::collect(const TileParts& parts, const TileParts::Whole& whole) const {
  if (whole.vertices > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("a mesh in memory cannot have {} vertices", whole.vertices));
  }
  Mesh mesh;
  mesh.vertices.resize(whole.vertices), mesh.faces.resize(whole.faces);
  mesh.attributes = attributes();
  for (Attribute& attribute : mesh.attributes) attribute.values.resize(whole.vertices);
  stages_.each("write", n_tiles_, [&](std::size_t tile) {
    PlyPart part = parts.part(tile);
    carry(tile, part.vertices);
    const auto at = static_cast<std::ptrdiff_t>(part.first_vertex);
    std::copy(part.vertices.vertices.begin(), part.vertices.vertices.end(),
              mesh.vertices.begin() + at);
    for (std::size_t k = 0; k < mesh.attributes.size(); ++k) {
      const std::vector<double>& values = part.vertices.attributes[k].values;
      std::copy(values.begin(), values.end(), mesh.attributes[k].values.begin() + at);
    }
    std::transform(part.faces.begin(), part.faces.end(),
                   mesh.faces.begin() + static_cast<std::ptrdiff_t>(part.first_triangle),
                   [](const WideTriangle& t) -> Triangle {
                     return {static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                             static_cast<std::uint32_t>(t[2])};
                   });
  });
  return mesh;
}

std::vector<Attribute> TileOutput::attributes() const {
  std::vector<Attribute> attributes;
  for (const char* axis : {"nx", "ny", "nz"}) {
    attributes.push_back({axis, ScalarType::kFloat32, {}});
  }
  for (const ColumnLayout& column : layout_.columns) {
    if (!is_left_out(column.name)) attributes.push_back({column.name, column.type, {}});
  }
  if (options_.confidence) set_attribute(attributes, {"confidence", ScalarType::kFloat32, {}});
  return attributes;
}

// Leaves out the sensor if it is the same for all points: surfaces need not know it.
bool TileOutput::is_left_out(const std::string& attribute) const {
  return options_.sensor &&
         std::find(kSensorAxes.begin(), kSensorAxes.end(), attribute) != kSensorAxes.end();
}

ConfidenceAreas TileOutput::carry(std::size_t tile, Mesh& vertices) const {
  if (layout_.columns.empty() && !options_.confidence) return {};
  const std::shared_ptr<const TileScene> scene = load_(tile);
  std::vector<Attribute> attributes = scene->attributes;
  if (options_.confidence) set_attribute(attributes, confidence_of(*scene));
  std::erase_if(attributes, [&](const Attribute& a) { return is_left_out(a.name); });
  carry_attributes(*scene->tree, attributes, vertices, stages_.context());
  if (!options_.confidence) return {};
  return add_confidence(scene->ordered(), vertices, stages_.context());
}

// Measures the triangles of each tile.
ConfidenceAreas TileOutput::measure_confidence(const TileParts& parts) const {
  const auto measure = [&](std::size_t tile) {
    const std::shared_ptr<const TileScene> scene = load_(tile);
    const Attribute sure = confidence_of(*scene);
    Mesh mesh = parts.kept_mesh(tile).mesh;
    carry_attributes(*scene->tree, std::span(&sure, 1), mesh, stages_.context());
    return std::vector{add_confidence(scene->ordered(), mesh, stages_.context())};
  };
  ConfidenceAreas sum;
  for (const ConfidenceAreas& areas :
       stages_.values<ConfidenceAreas>({"confidence", n_tiles_, {"confidence"}}, measure)) {
    sum += areas;
  }
  return sum;
}

}  // namespace rholm
