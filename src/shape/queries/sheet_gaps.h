// Computes the distance of a surface from itself, and its parts inside its own solid. Layer: shape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/queries/ray_scene.h"

namespace rholm {

// Points of a mesh, with the triangle that each point lies on.
struct PointsOnMesh {
  const Mesh& mesh;
  std::span<const Vec3> points;
  std::span<const std::uint32_t> faces;
};

// Returns the distance from each point, along its triangle's normal to either side, to the nearest
// triangle that faces the other way. This is the thickness of the solid, or the width of the gap
// outside of it; infinity if no triangle is met.
std::vector<double> sheet_gaps(const PointsOnMesh& on, const RayScene& scene,
                               const Context& context);

// Returns the winding number of the mesh just outside of each point, computed by crossings of
// rays. It is 0 outside a solid, positive if other parts of the mesh enclose the point, and
// negative if the mesh is inside out. The mesh must be closed. Coinciding sheets that face the
// same way do not enclose each other.
std::vector<int> outer_winding(const PointsOnMesh& on, const RayScene& scene,
                               const Context& context);

}  // namespace rholm
