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

// The point with the least slope of the radius, int |grad_S r|^2 dOmega, as far as a sample of the
// faces tells, on the line from the middle of the kernel to the centroid of the solid (all in the
// unit frame) and beyond.
Vec3 least_slope(const LocalView& view, const KernelCenter& middle, const Vec3& centroid);

// From the middle of the kernel towards `wanted` (in the unit frame), as far as no plane of a face
// comes nearer than a quarter of the smallest d_T at that middle. Returns `wanted` itself where its
// smallest d_T is so large.
Vec3 towards(const LocalView& view, const KernelCenter& middle, const Vec3& wanted,
             const Context& context);

// Maximises the smallest cos gamma over all corners, to 1e-6 of its value, from a start inside the
// kernel.
KernelCenter cosine_center(const LocalView& view, const Vec3& start, const Context& context);

}  // namespace rholm
