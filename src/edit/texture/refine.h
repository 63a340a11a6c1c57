// Refines triangles where an edit needs smaller ones. Layer: edit.
#pragma once

#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Splits edges longer than `length` that touch a vertex of weight > 0, with
// their triangles, repeatedly; `weights` grow with the mesh. Old vertices stay,
// and so does the surface where weights are 0. Elsewhere new vertices lie on
// the cubic defined by the normals at the ends (PN triangles, Vlachos et al.
// 2001). Throws InvalidInput if more than kMostRefined vertices were needed.
inline constexpr std::size_t kMostRefined = 20000000;
void refine(Mesh& mesh, std::vector<double>& weights, double length);

}  // namespace rholm
