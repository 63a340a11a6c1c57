// Where points were measured from. Layer: shape.
#pragma once

#include <array>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

inline constexpr std::array kSensorAxes = {"sensor_x", "sensor_y", "sensor_z"};

// Per point, from the attributes of these names; empty if one is missing or a value not finite.
std::vector<Vec3> sensors_of(const PointCloud& cloud);
// Sets the attributes that there are.
void set_sensors(PointCloud& cloud, const std::vector<Vec3>& sensors);

}  // namespace rholm
