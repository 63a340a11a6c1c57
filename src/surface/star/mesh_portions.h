// A mesh that need not fit in memory, in portions that do: its triangles as they lie, so many at a
// time, each portion with its own vertices.
#pragma once

#include <cstddef>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/mesh_view.h"
#include "rholm/topology.h"
#include "shape/queries/triangle_tree.h"

namespace rholm {

// The box of all vertices. Throws as validate() of the mesh.
Bounds checked_bounds(const MeshInPlace& mesh, const Context& context);

struct MeshPortion {
  Mesh mesh;  // scaled; vertices are in the order of the whole mesh
  PortionNumbers numbers;
};

class MeshPortions {
 public:
  // Of a valid mesh whose coordinates are taken times `scale`, in portions of at most so many
  // triangles. Keeps a reference to the mesh.
  MeshPortions(const MeshInPlace& mesh, double scale, std::size_t triangles);

  std::size_t size() const { return (n_triangles() + triangles_ - 1) / triangles_; }
  std::size_t n_triangles() const { return mesh_.mesh.n_triangles; }
  MeshPortion load(std::size_t p) const;
  // Triangles from all over the mesh, no more than of a portion, and 2^16.
  MeshPortion scouts() const;

 private:
  MeshPortion gather(const PortionNumbers& numbers, std::size_t n) const;

  const MeshInPlace& mesh_;
  double scale_;
  std::size_t triangles_;
};

}  // namespace rholm
