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

// Chosen by scripts/center-figures: with 0.1, 0.3 and 0.6 errors of asteroids whose centroid is
// near the border of the kernel differ by 2 %; nearer to it faces are seen all but edge on and take
// more quadrature nodes.
inline constexpr double kMargin = 0.25;

// The point with the least slope of the radius, int |grad_S r|^2 dOmega, on the line from the
// middle of the kernel to the centroid of the solid (all in the unit frame) and beyond. No plane of
// a face is nearer to it than kMargin of the smallest d_T at the middle of the kernel.
Vec3 least_slope(const LocalView& view, const KernelCenter& middle, const Vec3& centroid,
                 const Context& context);

// The share of the way from the middle of the kernel to `wanted` (in the unit frame) before a plane
// of a face is nearer than kMargin of the smallest d_T at that middle: 0 ... 1.
double share_of_way(const LocalView& view, const KernelCenter& middle, const Vec3& wanted,
                    const Context& context);

// Maximises the smallest cos gamma over all corners, to 1e-6 of its value, from a start inside the
// kernel.
KernelCenter cosine_center(const LocalView& view, const Vec3& start, const Context& context);

}  // namespace rholm
