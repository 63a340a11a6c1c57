// Whether a mesh is closed, without pairing its edges.
#pragma once

#include "rholm/mesh_view.h"

namespace rholm {

// Whether every edge is run through as often one way as the other, by a hash of its ends'
// coordinates: a surface that is not closed passes once in 2^60. Indices must be valid.
bool is_closed(const MeshView& mesh);

}  // namespace rholm
