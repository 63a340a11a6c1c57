// Reads and writes the sensor positions of points. Layer: shape.
#pragma once

#include <array>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

inline constexpr std::array kSensorAxes = {"sensor_x", "sensor_y", "sensor_z"};

// Returns the sensor of each point from these attributes; empty if one is missing or not finite.
std::vector<Vec3> sensors_of(const PointCloud& cloud);
// Sets the attributes with these names that exist.
void set_sensors(PointCloud& cloud, const std::vector<Vec3>& sensors);

}  // namespace rholm
