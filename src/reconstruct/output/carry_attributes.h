// Attributes of points on the vertices of their surface. Layer: reconstruct, private.
#pragma once

#include <span>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/points/point_tree.h"

namespace rholm {

// Gives each vertex the mean of the attributes of the points around it, weighted: the values are
// those of the points that the tree was made of, in their order. Rounded to their types.
void carry_attributes(const PointTree& tree, std::span<const Attribute> attributes, Mesh& mesh,
                      const Context& context);

}  // namespace rholm
