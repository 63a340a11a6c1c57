// Decides whether distances can be measured by closest points: method 5.
#pragma once

#include "rholm/coefficients.h"
#include "rholm/mesh_view.h"

namespace rholm {

// Returns true if faces are so few and long that closest points are always needed (chosen).
bool is_coarse(const MeshView& mesh);
// Returns true if closest points make sense. The sizes of model and mesh are comparable then, and
// the mesh is not too large for a tree in memory.
bool may_be_refined(const MeshView& mesh, const Expansion& expansion, double largest_radial_error,
                    double diagonal);

}  // namespace rholm
