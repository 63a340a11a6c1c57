// The inner loops of TriangleTree, in single precision: planes of triangles, and the walk down the
// tree.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/aligned_array.h"

namespace rholm {

inline constexpr std::size_t kTreeWidth = 8;  // children of a node, triangles of a leaf

using TreeRow = std::array<float, kTreeWidth>;
using TreeRows3 = std::array<TreeRow, 3>;  // x, y, z

// Boxes of the children of a node; those that are missing have infinite corners.
struct alignas(32) BoxGroup {
  TreeRows3 low, high;
  std::uint32_t first = 0;  // child, the others follow it
};

// Half spaces that hold a triangle, of which the distance is at least that to each: unit vectors m
// with the largest m . q of the corners q. The plane's normal has the smallest, too; the three
// beside the edges are orthogonal to it. All zero where there is no direction.
struct alignas(32) PlaneGroup {
  TreeRows3 normal;
  TreeRow low, high;
  std::array<TreeRows3, 3> side;
  TreeRows3 limit;  // of the three sides
};

// Nodes are numbered: leaves first, then what holds them, level by level; the last one is the root.
struct TriangleTreeNodes {
  AlignedArray<PlaneGroup> leaves;
  std::vector<BoxGroup> inner;
};

// corners[k]: x, y, z of corner k.
void set_planes(const std::array<TreeRows3, 3>& corners, PlaneGroup& planes);

// Calls try_triangle(leaf, k) for triangles whose distance from the point may be at most the
// radius, near ones first as a rule; it returns what the radius is from then on.
//
// With e = 2^-24, coordinates of the mesh at most 1 and those of the point at most s, a distance
// may come out too large by 10 (1 + s) e: point and corners are rounded, 1 e each of sqrt(3) s and
// of sqrt(3), and the sums of m . x have 3 e, in two directions. And by 12 e of itself: lengths of
// unit vectors are off by 4.5 e, their products by 5 e, which count half, and 2 e are those of the
// squares; of boxes it is less.
using TryTriangle = float (*)(void* search, std::size_t leaf, std::size_t k);
void walk_near(const TriangleTreeNodes& tree, const std::array<float, 3>& point, float radius,
               TryTriangle try_triangle, void* search);

}  // namespace rholm
