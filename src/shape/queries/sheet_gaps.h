// How near a surface comes to itself, and what of it lies inside its own solid. Layer: shape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/queries/ray_scene.h"

namespace rholm {

// Points of a mesh, and the triangle that each lies on.
struct PointsOnMesh {
  const Mesh& mesh;
  std::span<const Vec3> points;
  std::span<const std::uint32_t> triangles;
};

// The distance from each point, along the normal of its triangle to either side, to the nearest
// triangle that faces the other way: how thick the solid is there, or how wide the gap outside of
// it. Infinity where there is none.
std::vector<double> sheet_gaps(const PointsOnMesh& on, const RayScene& scene,
                               const Context& context);

// The winding number of the mesh just outside of each point, by crossings of rays: 0 on the outside
// of a solid, positive where other parts of the mesh enclose the point, negative where the mesh is
// inside out. The mesh must be closed. Coinciding sheets that face the same way do not enclose each
// other.
std::vector<int> outer_winding(const PointsOnMesh& on, const RayScene& scene,
                               const Context& context);

}  // namespace rholm
