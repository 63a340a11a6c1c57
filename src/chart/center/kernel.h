// Centres of the kernel: the points from which every face shows its front. Source: method 6.
#pragma once

#include "chart/center/local_view.h"
#include "rholm/context.h"

namespace rholm {

struct KernelCenter {
  Vec3 point;        // in the unit frame
  double value = 0;  // the smallest d_T (in the unit frame) or the smallest cos gamma there
  double scans = 0;  // passes over all triangles; those over some of them count in part
};

// The Chebyshev centre: maximises the smallest d_T over the bounding box, to 1e-12. Negative value:
// the kernel is empty.
KernelCenter chebyshev_center(const LocalView& view, const Context& context);

// Maximises the smallest cos gamma over all corners, to 1e-6 of its value, from a start inside the
// kernel.
KernelCenter cosine_center(const LocalView& view, const Vec3& start, const Context& context);

}  // namespace rholm
