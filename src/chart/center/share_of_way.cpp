// d_T is linear along a line, so each face limits how far the centre may move; the nearest limit
// counts. The kernel is convex, so every point between two of its points lies in it.
#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "chart/center/kernel.h"
#include "chart/center/view_scan.h"

namespace rholm {

double share_of_way(const LocalView& view, const KernelCenter& middle, const Vec3& wanted,
                    const Context& context) {
  const double least = kMargin * middle.value;
  const std::size_t n = view.mesh.n_faces, grain = triangle_grain(n);
  std::vector<double> parts((n + grain - 1) / grain, 1.0);
  parallel_for(n, grain, context, {}, [&](std::size_t begin, std::size_t end) {
    double& part = parts[begin / grain];
    const ScanLimits limits{.distance = least};
    scan_below(view, begin, end, wanted, limits, [&](std::size_t triangle) {
      const FacePlane face = view.plane(triangle);
      if (!face.exists()) return;
      // A plane that rounding may turn counts as far out as it may lie, as in
      // chebyshev_center().
      const double there = face.most_distance(wanted);
      if (!(there < least)) return;
      const double here = face.most_distance(middle.point);
      part = std::min(part, std::max(0.0, (here - least) / (here - there)));
    });
  });
  return *std::min_element(parts.begin(), parts.end());
}

}  // namespace rholm
