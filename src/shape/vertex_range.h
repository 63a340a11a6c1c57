// The bounding box of a mesh that lies in somebody else's memory. Layer: shape.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "rholm/context.h"
#include "rholm/mesh_view.h"

namespace rholm {

// The smallest and largest x, y and z.
struct VertexRange {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double min[3] = {kInfinity, kInfinity, kInfinity};
  double max[3] = {-kInfinity, -kInfinity, -kInfinity};
  bool finite = true;  // every coordinate is

  void add(std::size_t k, double low, double high) {
    min[k] = std::min(min[k], low);
    max[k] = std::max(max[k], high);
  }
};
VertexRange vertex_range(const MeshView& mesh, std::size_t begin, std::size_t end);
// Of all vertices, on several threads.
VertexRange vertex_range(const MeshView& mesh, const Context& context);

// Of the bounding box.
double diagonal_of(const MeshView& mesh, const Context& context);

}  // namespace rholm
