// Distances between a shape and the surface of its model. Layer: model, private.
#pragma once

#include <cstddef>
#include <vector>

#include "rholm/compress.h"
#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

AtlasErrors measure(const Mesh& shape, const Mesh& surface, std::size_t samples,
                    const Context& context);
// For a shape with intersecting parts: from points of its outer surface, and back to all of it.
AtlasErrors measure(const std::vector<Vec3>& outer, const Mesh& shape, const Mesh& surface,
                    std::size_t samples, const Context& context);
// Measures only from the points to the surface.
AtlasErrors measure(const std::vector<Vec3>& points, const Mesh& surface, const Context& context);

}  // namespace rholm
