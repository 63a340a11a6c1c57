// Sorts triangles so that neighbours in space are neighbours in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "base/aligned_array.h"
#include "rholm/context.h"
#include "rholm/mesh_view.h"

namespace rholm {

enum class TriangleKey {
  kVertex,   // by the smallest corner index: if vertices are in order already
  kPosition  // by the first corner's position along a Morton curve through the bounding box
};

struct OrderedTriangles {
  AlignedArray<std::uint32_t> corners;  // three indices of each triangle
  MeshView view;                        // the mesh in this order; valid as long as this object
};

// Returns a sorted copy: some 12 bytes per triangle, 14 while it is made. Calls before(first, n)
// and after(first, n) around the first reading of n triangles, in order per thread; either may be
// empty. Indices out of range are kept. Any number of threads gives the same result.
using TriangleVisit = std::function<void(std::size_t first, std::size_t n)>;
OrderedTriangles order_triangles(const MeshView& mesh, TriangleKey key, const TriangleVisit& before,
                                 const TriangleVisit& after, const Context& context);

// Returns true if consecutive vertices are much nearer to each other than random
// ones, judged by a sample.
bool vertices_in_order(const MeshView& mesh);

}  // namespace rholm
