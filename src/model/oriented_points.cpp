#include "model/oriented_points.h"

#include "base/refuse.h"

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

}  // namespace rholm
