// Computes the bounding box of a mesh in memory of the caller. Layer: shape.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "rholm/context.h"
#include "rholm/mesh_view.h"

namespace rholm {

// The smallest and largest x, y and z of some vertices.
struct VertexRange {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double min[3] = {kInfinity, kInfinity, kInfinity};
  double max[3] = {-kInfinity, -kInfinity, -kInfinity};
  bool finite = true;  // true if every coordinate is finite

  void add(std::size_t k, double low, double high) {
    min[k] = std::min(min[k], low);
    max[k] = std::max(max[k], high);
  }
};
VertexRange vertex_range(const MeshView& mesh, std::size_t begin, std::size_t end);
// Returns the range of all vertices, computed on several threads.
VertexRange vertex_range(const MeshView& mesh, const Context& context);

// Returns the diagonal of the bounding box.
double diagonal_of(const MeshView& mesh, const Context& context);

}  // namespace rholm
