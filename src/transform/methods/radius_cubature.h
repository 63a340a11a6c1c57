// Nodes of r dOmega = d_T dS / |x|^2 on a flat face.
#pragma once

#include <algorithm>
#include <cmath>

#include "transform/geometry/star_geometry.h"
#include "transform/methods/sources.h"

namespace rholm {

// Returns about int |r| dOmega over the face: |solid angle| times the largest radius.
inline double radius_weight(const StarGeometry& geometry, std::size_t t) {
  double radius = 0;
  for (const Vec3& corner : geometry.corners(t)) radius = std::max(radius, norm(corner));
  return std::abs(geometry.faces[t].solid_angle) * radius;
}

// Returns the sum over all faces.
inline double radius_weight(const StarGeometry& geometry) {
  double total = 0;
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) total += radius_weight(geometry, t);
  return total;
}

// Calls visit(x, weight of r dOmega) for the nodes of a face.
template <typename Visit>
void visit_radius(const StarGeometry& geometry, std::size_t t, const Allowance& allowance,
                  const Visit& visit) {
  const FaceGeometry& face = geometry.faces[t];
  if (face.degenerate || face.d == 0) return;
  const double factor = face.d * norm(face.twice_area) / 2;
  visit_triangle(geometry.corners(t), allowance,
                 [&](const Vec3& x, double w) { visit(x, w * factor / dot(x, x)); });
}

}  // namespace rholm
