// Triangles in an order in which neighbours in space are neighbours in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "base/aligned_array.h"
#include "rholm/context.h"
#include "rholm/mesh_view.h"

namespace rholm {

enum class TriangleKey {
  kVertex,   // by the smallest index of a corner: where vertices are in order already
  kPosition  // by the place of the first corner along a Morton curve through the bounding box
};

struct OrderedTriangles {
  AlignedArray<std::uint32_t> corners;  // three of each triangle
  MeshView view;                        // of the mesh in that order; good as long as this object
};

// A copy of the triangles, sorted: some 12 bytes each, 14 while it is made. Calls before(first, n)
// and after(first, n) around the first reading of n triangles, in order within a thread; either may
// be empty. Indices out of range are kept as they are. Same result for any number of threads.
using TriangleVisit = std::function<void(std::size_t first, std::size_t n)>;
OrderedTriangles order_triangles(const MeshView& mesh, TriangleKey key, const TriangleVisit& before,
                                 const TriangleVisit& after, const Context& context);

// Whether vertices that follow each other are much nearer to each other than any two, from a
// sample.
bool vertices_in_order(const MeshView& mesh);

}  // namespace rholm
