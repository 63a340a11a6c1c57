// The vertices of a mesh as points. Layer: reconstruct, private.
#pragma once

#include "rholm/mesh.h"

namespace rholm {

// With the mean normals of their faces, weighted by area, in the place of normals of their own.
PointCloud points_of_mesh(Mesh mesh);

}  // namespace rholm
