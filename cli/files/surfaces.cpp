#include "cli/files/surfaces.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/files/paths.h"
#include "rholm/compress.h"
#include "rholm/primitives.h"
#include "rholm/synthesize.h"

namespace rholm::cli {

int subdivisions_for(int degree, const Fineness& fineness) {
  const double wanted = fineness.vertices_per_coefficient * (degree + 1.0) * (degree + 1.0);
  int n = fineness.min;
  for (double vertices = 10.0 * (1 << (2 * n)) + 2; n < fineness.max && vertices < wanted; ++n) {
    vertices = 4 * vertices - 6;  // 10 4^n + 2 for the next n
  }
  return n;
}

void warn_of_crossings(const Mesh& surface, const Mesh& sphere, const Vec3& center,
                       const std::string& name, Session& session) {
  std::size_t crossings = 0;
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    crossings += dot(surface.vertices[i] - center, sphere.vertices[i]) <= 0;
  }
  if (crossings == 0) return;
  session.warn(
      fmt::format("{}: the series has a radius r <= 0 at {} of {} vertices, where the surface "
                  "crosses its centre; try another degree",
                  name, crossings, surface.vertices.size()));
}

Mesh surface_of(const Input& input, const std::string& path, std::optional<int> degree,
                std::optional<int> subdivisions, Session& session) {
  if (const auto* file = std::get_if<ShapeFile>(&input)) return mesh_of(*file, path, session);
  const Expansion& expansion = std::get<CoefficientsFile>(input).expansion;
  const int wanted =
      std::min(degree.value_or(expansion.coefficients.degree()), expansion.coefficients.degree());
  const Mesh sphere = icosphere(subdivisions.value_or(subdivisions_for(wanted, kForMeasuring)));
  Mesh surface = synthesize(expansion, sphere, std::span(&wanted, 1), session.context()).front();
  warn_of_crossings(surface, sphere, expansion.center, display_name(path), session);
  return surface;
}

Mesh read_surface(const std::string& path, Session& session, const InputConvention& convention) {
  if (holds_atlas(path)) return synthesize(read_atlas(path), {}, session.context());
  Input input = read_surface_input(path, session, convention);
  if (auto* file = std::get_if<ShapeFile>(&input)) return mesh_of(std::move(*file), path, session);
  return surface_of(input, path, std::nullopt, std::nullopt, session);
}

}  // namespace rholm::cli
