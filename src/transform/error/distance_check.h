// Whether distances can be those of closest points: method 5.
#pragma once

#include "rholm/coefficients.h"
#include "rholm/mesh_view.h"

namespace rholm {

// Faces so few and long that closest points rule whatever a sample says (chosen).
bool is_coarse(const MeshView& mesh);
// Whether closest points make sense: a model whose size compares with the mesh's, which is not too
// large for a tree of it in memory.
bool may_be_refined(const MeshView& mesh, const Expansion& expansion, double largest_radial_error,
                    double diagonal);

}  // namespace rholm
