// Centres of the kernel: the points from which every face shows its front. Source: method 6.
#pragma once

#include "chart/face_planes.h"
#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

struct KernelCenter {
  Vec3 point;        // in the unit frame
  double value = 0;  // the smallest d_T (in the unit frame) or the smallest cos gamma there
  int scans = 0;     // passes over all triangles
};

// The Chebyshev centre: maximises the smallest d_T over the bounding box. Negative value: the
// kernel is empty.
KernelCenter chebyshev_center(const FacePlanes& faces, const Context& context);

// Maximises the smallest cos gamma over all corners, to 1e-6 of its value, from a start inside the
// kernel.
KernelCenter cosine_center(const Mesh& mesh, const FacePlanes& faces, const Vec3& start,
                           const Context& context);

}  // namespace rholm
