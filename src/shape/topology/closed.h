// Tells whether a mesh is closed, without pairing its edges.
#pragma once

#include "rholm/mesh_view.h"

namespace rholm {

// Returns true if every edge is used equally often in both directions, tested by a hash of its
// ends' coordinates. An open surface passes once in 2^60. Indices must be valid.
bool is_closed(const MeshView& mesh);

}  // namespace rholm
