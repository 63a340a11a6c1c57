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

// From the centre, times `scale`.
std::array<Vec3, 3> corners_of(const MeshView& mesh, const Triangle& triangle, const Vec3& center,
                               double scale);

// Points of the face t, from the centre and times scan.sizes.scale.
using PointsOnFace = std::function<void(std::span<const Vec3> points, std::size_t t)>;

// Of each face with an edge longer than 1.5/L three or seven points, on it and its edges but not at
// its corners: calls visit() for faces of the runs [begin, end) of the scan.
void visit_long_faces(const MeshView& mesh, const Vec3& center, const FaceScan& scan, int degree,
                      std::size_t begin, std::size_t end, const PointsOnFace& visit);

// The faces on which the seven points lie farther than 1.5/L apart, in ascending order.
std::vector<std::size_t> longest_faces(const MeshView& mesh, const Vec3& center,
                                       const FaceScan& scan, int degree);
// Calls visit() several times with points of the face t that lie at most 1.5/L apart, on it and its
// edges, some of them more than once.
void visit_dense_points(const MeshView& mesh, const Vec3& center, const FaceScan& scan, int degree,
                        std::size_t t, const PointsOnFace& visit);

}  // namespace rholm
