// Surfaces for display and measurement: a mesh unchanged, or a model on a sphere fine enough for
// its degree. Layer: cli.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/files/inputs.h"
#include "cli/terminal/session.h"
#include "rholm/coefficients.h"
#include "rholm/mesh.h"

namespace rholm::cli {

// Resolution at which an icosphere samples a model: at least `vertices_per_coefficient` (L + 1)^2
// vertices, subdivisions within min ... max.
struct Fineness {
  int vertices_per_coefficient = 2;
  int min = 4;
  int max = 7;
};
// For output meshes: two vertices per coefficient follow the shortest wave; at most 163 842.
inline constexpr Fineness kForFiles = {2, 4, 7};
// For measurement and display: with 16 vertices per coefficient the edges h cut off 1/9 of the
// shortest wave's height, (h L)^2 / 8 with h^2 = 8 pi / (sqrt 3 16 L^2); at most 655 362 vertices.
inline constexpr Fineness kForMeasuring = {16, 5, 8};

int subdivisions_for(int degree, const Fineness& fineness);

// Returns the surface of an input: the mesh, or the model truncated at `degree` on an icosphere
// with these subdivisions (by default kForMeasuring).
Mesh surface_of(const Input& input, const std::string& path, std::optional<int> degree,
                std::optional<int> subdivisions, Session& session);

// Reads a mesh to edit: the file's mesh, or the surface of its coefficients or atlas.
Mesh read_surface(const std::string& path, Session& session, const InputConvention& convention);

// Warns if some vertices of a surface lie on the wrong side of the centre, r <= 0.
void warn_of_crossings(const Mesh& surface, const Mesh& sphere, const Vec3& center,
                       const std::string& name, Session& session);

}  // namespace rholm::cli
