// Surfaces in single precision. Layer: studio.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/mesh.h"
#include "rholm/vec3.h"

namespace rholm::studio {

// Triangles whose corners are the first vertices of all at the same place: what a seam of the file
// cuts is one surface.
std::vector<Triangle> joined_triangles(const Mesh& mesh);
// Unit normals of vertices, weighted by areas; 0 where there is no area. positions and result
// [n][3]. `joined`: joined_triangles() of the mesh; vertices that are in none of these have the
// normal of the first one in their place.
std::vector<float> normals_of(std::span<const float> positions, std::span<const Triangle> triangles,
                              std::span<const Triangle> joined);
// Bytes red, green, blue [n][3]; empty if there are none.
std::vector<std::uint8_t> colors_of(const Mesh& mesh);
std::vector<std::uint8_t> colors_of(const PointCloud& cloud);

}  // namespace rholm::studio
