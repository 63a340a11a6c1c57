// Swaps coefficients between two caps. Layer: edit.
#pragma once

#include "edit/texture/textured_patch.h"

namespace rholm {

// Returns positions of target.patch's vertices. A cap over the source, turned
// by `angle` and scaled by `height`, replaces the coefficients of degree >
// from_degree of a cap over the target. Vertices outside the region stay.
std::vector<Vec3> swap_coefficients(const TexturedPatch& source, const TexturedPatch& target,
                                    int from_degree, double angle, double height);

}  // namespace rholm
