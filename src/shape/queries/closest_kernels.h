// Computes planes of triangles, and walks down the tree, for TriangleTree in single precision.
// These are its inner loops.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/aligned_array.h"

namespace rholm {

inline constexpr std::size_t kTreeWidth = 8;  // children of a node, triangles of a leaf

using TreeRow = std::array<float, kTreeWidth>;
using TreeRows3 = std::array<TreeRow, 3>;  // x, y, z

// Bounding boxes of the children of a node; missing children have infinite corners.
struct alignas(32) BoxGroup {
  TreeRows3 low, high;
  std::uint32_t first = 0;  // index of the first child; the others follow it
};

// Half spaces that contain a triangle; its distance is at least the distance to each of them.
// `normal`, `low`, `high`: unit normal m of the plane, least and largest m . q over the corners q.
// `side`, `limit`: m, orthogonal to it, and largest m . q beside each edge. Zero if degenerate.
struct alignas(32) PlaneGroup {
  TreeRows3 normal;
  TreeRow low, high;
  std::array<TreeRows3, 3> side;
  TreeRows3 limit;  // largest m . q of the three sides
};

// Numbers of nodes: first leaves, then their parents, level by level; the last node is the root.
struct TriangleTreeNodes {
  AlignedArray<PlaneGroup> leaves;
  std::vector<BoxGroup> inner;
};

// Computes the half spaces; corners[k] has x, y, z of corner k.
void set_planes(const std::array<TreeRows3, 3>& corners, PlaneGroup& planes);

// Calls try_triangle(leaf, k) for triangles whose distance may be at most the radius, usually
// near ones first. Each call returns the radius to be used from then on.
//
// Let e = 2^-24, mesh coordinates at most 1, and coordinates of the point at most s. A
// distance may be too large by 10 (1 + s) e: rounding adds 1 e each to sqrt(3) s and sqrt(3),
// and sums of m . x have 3 e, in two directions. A relative error of 12 e is added: lengths of
// unit vectors are off by 4.5 e, their products by 5 e, which count half, and squares by 2 e.
// Errors for boxes are smaller.
using TryTriangle = float (*)(void* search, std::size_t leaf, std::size_t k);
void walk_near(const TriangleTreeNodes& tree, const std::array<float, 3>& point, float radius,
               TryTriangle try_triangle, void* search);

}  // namespace rholm
