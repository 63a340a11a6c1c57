// Tells whether two processes have the same mesh.
#pragma once

#include <cstdint>

#include "rholm/mesh_view.h"

namespace rholm {

// Returns a hash of the numbers of vertices and triangles, and of up to 1024 of each.
std::uint64_t fingerprint(const MeshView& mesh);

}  // namespace rholm
