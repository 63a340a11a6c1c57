// Whether two processes have the same mesh.
#pragma once

#include <cstdint>

#include "rholm/mesh_view.h"

namespace rholm {

// A hash of the numbers of vertices and triangles, and of a thousand of each.
std::uint64_t fingerprint(const MeshView& mesh);

}  // namespace rholm
