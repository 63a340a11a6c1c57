// Computes centres in the kernel: points from which every face is front-facing. Source: method 6.
#pragma once

#include "chart/center/local_view.h"
#include "rholm/context.h"

namespace rholm {

struct KernelCenter {
  Vec3 point;        // in the unit frame
  double value = 0;  // the smallest d_T (in the unit frame) or the smallest cos gamma there
  double scans = 0;  // passes over all triangles; a pass over part of them counts in part
};

// Returns the Chebyshev centre, which maximises the smallest d_T over the bounding box, to 1e-12.
// The kernel is empty if `value` is negative.
KernelCenter chebyshev_center(const LocalView& view, const Context& context);

// Least distance from the kernel's border, relative to the smallest d_T at the kernel's middle.
// Chosen by scripts/center-figures: with 0.1, 0.3 and 0.6, errors of asteroids whose centroid is
// near the border differ by 2 %. Nearer the border, faces seen edge-on take more quadrature nodes.
inline constexpr double kMargin = 0.25;

// Returns the point of least slope of the radius, int |grad_S r|^2 dOmega. The point lies on the
// line through the kernel's middle and the solid's centroid (all in the unit frame). No plane of a
// face is nearer to it than kMargin times the smallest d_T at the middle of the kernel.
Vec3 least_slope(const LocalView& view, const KernelCenter& middle, const Vec3& centroid,
                 const Context& context);

// Returns the allowed share, 0 ... 1, of the way from the kernel's middle to `wanted` (in the unit
// frame). No plane gets nearer than kMargin times the smallest d_T at the middle.
double share_of_way(const LocalView& view, const KernelCenter& middle, const Vec3& wanted,
                    const Context& context);

// Maximises the smallest cos gamma over all corners, to 1e-6 of its value, starting from a point
// inside the kernel.
KernelCenter cosine_center(const LocalView& view, const Vec3& start, const Context& context);

}  // namespace rholm
