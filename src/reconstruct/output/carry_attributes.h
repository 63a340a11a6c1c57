// Attributes of points on the vertices of their surface. Layer: reconstruct, private.
#pragma once

#include <span>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/points/point_tree.h"

namespace rholm {

// Gives each vertex the weighted mean of the attributes of the points around it, rounded to their
// types. Values are in the order of the points that the tree was made of.
void carry_attributes(const PointTree& tree, std::span<const Attribute> attributes, Mesh& mesh,
                      const Context& context);

}  // namespace rholm
