// Surfaces from points in one piece. Layer: reconstruct, private.
#pragma once

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/reconstruct.h"

namespace rholm {

// The surface of points that are no more than a tile; writes nothing.
Reconstruction reconstruct_piece(PointCloud cloud, const ReconstructOptions& options,
                                 const Context& context);

}  // namespace rholm
