// Surfaces in single precision. Layer: studio.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/mesh.h"
#include "rholm/vec3.h"

namespace rholm::studio {

// Unit normals of vertices, weighted by areas; 0 where there is no area. positions and result
// [n][3].
std::vector<float> normals_of(std::span<const float> positions,
                              std::span<const Triangle> triangles);
// Bytes red, green, blue [n][3]; empty if there are none.
std::vector<std::uint8_t> colors_of(const Mesh& mesh);
std::vector<std::uint8_t> colors_of(const PointCloud& cloud);

}  // namespace rholm::studio
