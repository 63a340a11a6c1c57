// Where a surface turns around within a length. Layer: surface.
#pragma once

#include <cstdint>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/normal_attributes.h"

namespace rholm {

// Vertices, ascending, of which every closed curve on the surface of at most that length that is
// the shortest around something passes one, more or less: found by normals.
std::vector<std::uint32_t> tight_places(const Mesh& mesh, const NormalAttributes& normals,
                                        double length, const Context& context);

}  // namespace rholm
