// Points that have normals, as atlases are made of them.
#pragma once

#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

// Throws InvalidInput unless the cloud is valid and has normals.
void check_oriented(const PointCloud& cloud);

// One normal of length 1 per point.
struct OrientedPoints {
  std::vector<Vec3> points, normals;
};

// The points with a normal that is not zero, in their order. One normal per point, of any length.
OrientedPoints oriented_points(const std::vector<Vec3>& points, const std::vector<Vec3>& normals);

// Turns all normals if they face inwards; returns whether they did.
bool turn_outwards(OrientedPoints& samples, const Context& context);

// Throws InvalidInput for a diagonal whose caps leave the range of single precision, which stores
// squares of distances.
void check_span(double diagonal);

}  // namespace rholm
