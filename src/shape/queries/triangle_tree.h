// Exact closest points on a triangle mesh.
//
// A tree of float boxes around coordinates shifted to the mesh's centre tells which triangles can
// be nearest; these are then measured in double, on the mesh's own vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/mesh.h"
#include "shape/face.h"
#include "shape/queries/closest_kernels.h"

namespace rholm {

struct ClosestPoint {
  Vec3 point;
  std::uint32_t triangle = 0;
  double distance = 0;
};

// Keeps a reference to `mesh`, which must outlive it. Queries may come from several threads at
// once.
class TriangleTree {
 public:
  explicit TriangleTree(const Mesh& mesh);

  // The mesh must have a triangle. Ties go to the triangle with the smaller index.
  ClosestPoint closest(const Vec3& point) const;
  // The same of each: faster where neighbours in the list are near each other.
  std::vector<ClosestPoint> closest(std::span<const Vec3> points) const;

 private:
  ClosestPoint closest_within(const Vec3& point, double at_most) const;
  void sort_triangles();
  void build();

  const Mesh& mesh_;
  UnitFrame frame_;
  std::vector<std::uint32_t> order_;  // of the triangles in the leaves
  TriangleTreeNodes nodes_;
};

}  // namespace rholm
