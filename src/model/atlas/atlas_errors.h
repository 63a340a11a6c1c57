// How far a shape is from the surface of its model. Layer: model, private.
#pragma once

#include <cstddef>
#include <vector>

#include "rholm/compress.h"
#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

AtlasErrors measure(const Mesh& shape, const Mesh& surface, std::size_t samples,
                    const Context& context);
// Of a shape whose parts run into each other: from points of its outer surface, and back to all.
AtlasErrors measure(const std::vector<Vec3>& outer, const Mesh& shape, const Mesh& surface,
                    std::size_t samples, const Context& context);
// From the points to the surface only.
AtlasErrors measure(const std::vector<Vec3>& points, const Mesh& surface, const Context& context);

}  // namespace rholm
