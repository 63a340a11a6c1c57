// Surfaces for looking and measuring: a mesh as it is, a model on a sphere fine enough for its
// degree. Layer: cli.
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

// How finely an icosphere samples a model: the number of its vertices is at least
// `vertices_per_coefficient` (L + 1)^2, its subdivisions stay within min ... max.
struct Fineness {
  int vertices_per_coefficient = 2;
  int min = 4;
  int max = 7;
};
// For a mesh to be kept: two vertices a coefficient follow the shortest wave; at most 163 842.
inline constexpr Fineness kForFiles = {2, 4, 7};
// For measuring and looking: with 16 vertices a coefficient the edges h cut off 1/9 of the height
// of the shortest wave, (h L)^2 / 8 with h^2 = 8 pi / (sqrt 3 16 L^2); at most 655 362 vertices.
inline constexpr Fineness kForMeasuring = {16, 5, 8};

int subdivisions_for(int degree, const Fineness& fineness);

// The surface of an input: the mesh itself, or the model cut off at `degree` on an icosphere of
// the given subdivisions, by default kForMeasuring's.
Mesh surface_of(const Input& input, const std::string& path, std::optional<int> degree,
                std::optional<int> subdivisions, Session& session);

// A mesh to be edited: the file's, or the surface of its coefficients or of its atlas.
Mesh read_surface(const std::string& path, Session& session, const InputConvention& convention);

// Tells the user if some vertices of a surface r <= 0 lie on the wrong side of the centre.
void warn_of_crossings(const Mesh& surface, const Mesh& sphere, const Vec3& center,
                       const std::string& name, Session& session);

}  // namespace rholm::cli
