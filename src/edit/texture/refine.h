// Finer triangles where an edit needs them. Layer: edit.
#pragma once

#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Splits edges longer than `length` that touch a vertex of weight > 0, and their triangles with
// them, again and again; `weights` grow with the mesh. Old vertices stay where they are, and so
// does the surface where weights are 0; elsewhere new ones lie on the cubic that the ends' normals
// give (PN triangles, Vlachos et al. 2001). Throws InvalidInput if there would be more than
// kMostRefined vertices.
inline constexpr std::size_t kMostRefined = 20000000;
void refine(Mesh& mesh, std::vector<double>& weights, double length);

}  // namespace rholm
