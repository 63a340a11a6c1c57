// Surfaces in single precision. Layer: studio.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/mesh.h"
#include "rholm/vec3.h"

namespace rholm::studio {

// Returns triangles whose corners are the first of all vertices at the
// same place, so that a surface cut by a seam of the file is joined.
std::vector<Triangle> joined_triangles(const Mesh& mesh);
// Returns unit normals of vertices, weighted by areas; 0 where there is no area.
// Positions and result are [n][3]. `joined` is joined_triangles() of the mesh;
// vertices outside these triangles have the normal of the first vertex at their place.
std::vector<float> normals_of(std::span<const float> positions, std::span<const Triangle> triangles,
                              std::span<const Triangle> joined);
// Returns bytes red, green, blue [n][3]; empty if there are no colours.
std::vector<std::uint8_t> colors_of(const Mesh& mesh);
std::vector<std::uint8_t> colors_of(const PointCloud& cloud);

}  // namespace rholm::studio
