#include "reconstruct/points/oriented_points.h"

#include <fmt/format.h>

#include "base/refuse.h"
#include "shape/points/side_balance.h"

namespace rholm {

void check_oriented(const PointCloud& cloud) {
  validate(cloud);
  if (cloud.normals.size() != cloud.points.size()) {
    refuse("points need normals that point outwards: 'rholm orient' gives them");
  }
}

OrientedPoints oriented_points(const std::vector<Vec3>& points, const std::vector<Vec3>& normals) {
  OrientedPoints result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(norm(normals[i]) > 0)) continue;
    result.points.push_back(points[i]);
    result.normals.push_back(normalized(normals[i]));
  }
  return result;
}

bool turn_outwards(OrientedPoints& samples, const Context& context) {
  const PointTree tree(samples.points, context);
  const OrientedPoints sorted = [&] {
    OrientedPoints result;
    for (const std::uint32_t i : tree.order()) {
      result.points.push_back(samples.points[i]);
      result.normals.push_back(samples.normals[i]);
    }
    return result;
  }();
  if (!balance_sides(tree, sorted.points, sorted.normals, context).inwards) return false;
  for (Vec3& normal : samples.normals) normal = -normal;
  return true;
}

void check_span(double diagonal) {
  constexpr double kSmallest = 1e-12, kLargest = 1e12;
  if (diagonal >= kSmallest && diagonal <= kLargest) return;
  refuse(
      fmt::format("the shape spans {:.6g}: {} ... {:g} can be worked with; take another unit of "
                  "length",
                  diagonal, kSmallest, kLargest));
}

}  // namespace rholm
