// The raw swap of coefficients between caps. Layer: edit.
#pragma once

#include "edit/texture/textured_patch.h"

namespace rholm {

// Positions of target.patch's vertices when the coefficients of degree > from_degree of one cap
// over the target are those of a cap over the source, turned by `angle` and times `height`.
// Vertices outside the region stay.
std::vector<Vec3> swap_coefficients(const TexturedPatch& source, const TexturedPatch& target,
                                    int from_degree, double angle, double height);

}  // namespace rholm
