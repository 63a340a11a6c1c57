// Splits a mesh that may exceed memory into portions that fit:
// consecutive triangles of the mesh, each portion with its own vertices.
#pragma once

#include <cstddef>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/mesh_view.h"
#include "rholm/topology.h"
#include "shape/queries/triangle_tree.h"

namespace rholm {

// Returns the box of all vertices. Throws the same errors as validate().
Bounds checked_bounds(const MeshInPlace& mesh, const Context& context);

struct MeshPortion {
  Mesh mesh;  // scaled mesh; vertices keep the order of the whole mesh
  PortionNumbers numbers;
};

class MeshPortions {
 public:
  // Splits a valid mesh into portions of at most `triangles` triangles,
  // with coordinates times `scale`. Keeps a reference to the mesh.
  MeshPortions(const MeshInPlace& mesh, double scale, std::size_t triangles);

  std::size_t size() const { return (n_faces() + triangles_ - 1) / triangles_; }
  std::size_t n_faces() const { return mesh_.mesh.n_faces; }
  MeshPortion load(std::size_t p) const;
  // Returns triangles from all over the mesh: at most a portion's number, and at most 2^16.
  MeshPortion scouts() const;

 private:
  MeshPortion gather(const PortionNumbers& numbers, std::size_t n) const;

  const MeshInPlace& mesh_;
  double scale_;
  std::size_t triangles_;
};

}  // namespace rholm
