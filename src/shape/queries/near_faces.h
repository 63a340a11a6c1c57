// The faces of a mesh that have the closest points to a few balls' centres, without a tree of all.
#pragma once

#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/mesh_view.h"

namespace rholm {

// Balls that reach the surface: its closest point to a centre is within the ball's radius.
struct Balls {
  std::vector<Vec3> centers;
  std::vector<double> radii;

  void add(const Vec3& center, double radius) {
    centers.push_back(center);
    radii.push_back(radius);
  }
};

// All faces that touch a ball and some more, in their order, with corners of their own at
// scale (v - origin), the coordinates of the balls. Where balls are small against the mesh, a
// TriangleTree of them is made in a small part of the time that one of the whole mesh takes.
Mesh faces_near(const MeshView& mesh, const Vec3& origin, double scale, const Balls& balls,
                const Context& context);

}  // namespace rholm
