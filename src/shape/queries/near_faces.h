// Finds the faces of a mesh with the closest points to the centres of some balls, without a tree.
#pragma once

#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/mesh_view.h"

namespace rholm {

// Balls that reach the surface: the closest point to a centre is within the ball's radius.
struct Balls {
  std::vector<Vec3> centers;
  std::vector<double> radii;

  void add(const Vec3& center, double radius) {
    centers.push_back(center);
    radii.push_back(radius);
  }
};

// Returns all faces that touch a ball and some others, in their order. Each face has its own
// corners at scale (v - origin), the coordinates of the balls. If balls are small against the mesh,
// a TriangleTree of the result takes a small part of the time of a tree of the whole mesh.
Mesh faces_near(const MeshView& mesh, const Vec3& origin, double scale, const Balls& balls,
                const Context& context);

}  // namespace rholm
