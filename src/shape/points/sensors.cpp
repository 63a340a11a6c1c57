#include "shape/points/sensors.h"

#include <algorithm>
#include <cstddef>

namespace rholm {

std::vector<Vec3> sensors_of(const PointCloud& cloud) {
  std::array<const Attribute*, 3> axes{};
  for (std::size_t k = 0; k < 3; ++k) {
    axes[k] = find_attribute(cloud.attributes, kSensorAxes[k]);
    if (axes[k] == nullptr) return {};
  }
  std::vector<Vec3> sensors(cloud.points.size());
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    sensors[i] = {axes[0]->values[i], axes[1]->values[i], axes[2]->values[i]};
  }
  if (!std::all_of(sensors.begin(), sensors.end(), is_finite)) return {};
  return sensors;
}

void set_sensors(PointCloud& cloud, const std::vector<Vec3>& sensors) {
  for (Attribute& attribute : cloud.attributes) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (attribute.name != kSensorAxes[k]) continue;
      for (std::size_t i = 0; i < sensors.size(); ++i) {
        attribute.values[i] = k == 0 ? sensors[i].x : k == 1 ? sensors[i].y : sensors[i].z;
      }
    }
  }
}

}  // namespace rholm
