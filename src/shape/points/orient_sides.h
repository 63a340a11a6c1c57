// Which side of oriented parts is the outer one. Layer: shape.
#pragma once

#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/orient_graph.h"

namespace rholm {

// Turns components, and pieces of them that were joined in doubt, as a whole: to enclose a
// positive volume, and so that the winding number of all falls from 1 to 0 along the normals.
// `areas` is the surface that each point stands for. Returns for every component how nearly it
// does, 0 ... 1.
std::vector<double> turn_outwards(std::span<const Vec3> points, std::span<const double> areas,
                                  const OrientedParts& parts, std::vector<Vec3>& normals,
                                  const Context& context);

}  // namespace rholm
