// Points on faces that are long against 1/L: waves of degree L are 2 pi / L long.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "rholm/mesh_view.h"
#include "transform/error/face_scan.h"

namespace rholm {

// Returns the corners relative to the centre, times `scale`.
std::array<Vec3, 3> corners_of(const MeshView& mesh, const Triangle& triangle, const Vec3& center,
                               double scale);

// Takes points of the face t, relative to the centre and times scan.sizes.scale.
using PointsOnFace = std::function<void(std::span<const Vec3> points, std::size_t t)>;

// Calls visit() for each face in the runs [begin, end) of the scan that has an edge longer than
// 1.5/L. The three or seven points are on the face and its edges, but not at its corners.
void visit_long_faces(const MeshView& mesh, const Vec3& center, const FaceScan& scan, int degree,
                      std::size_t begin, std::size_t end, const PointsOnFace& visit);

// Returns the faces on which the seven points are more than 1.5/L apart, in ascending order.
std::vector<std::size_t> longest_faces(const MeshView& mesh, const Vec3& center,
                                       const FaceScan& scan, int degree);
// Calls visit() several times with points of the face t and its edges that are at most 1.5/L apart.
// Some points are visited more than once.
void visit_dense_points(const MeshView& mesh, const Vec3& center, const FaceScan& scan, int degree,
                        std::size_t t, const PointsOnFace& visit);

}  // namespace rholm
