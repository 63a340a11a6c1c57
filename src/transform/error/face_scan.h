// What the choice of points at which errors are measured wants to know of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/norms/exact_norms.h"

namespace rholm {

struct FaceScan {
  FaceSizes sizes;
  // Of each vertex, 1 if it belongs to a face: one of no face is no point of the surface. Empty if
  // all do.
  std::vector<std::uint8_t> used;

  bool is_used(std::size_t vertex) const { return used.empty() || used[vertex] != 0; }
};
// Of a closed star-shaped mesh.
FaceScan scan_faces(const MeshView& mesh, FaceSizes sizes);
FaceScan scan_faces(const MeshView& mesh, const Vec3& center, const Context& context);

}  // namespace rholm
