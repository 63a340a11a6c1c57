// Properties of a mesh that the choice of measuring points needs.
#pragma once

#include <cstdint>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/norms/exact_norms.h"

namespace rholm {

struct FaceScan {
  FaceSizes sizes;
  // For each vertex: 1 if it belongs to a face. A vertex of no face is no point of the surface.
  // Empty if all vertices belong to faces.
  std::vector<std::uint8_t> used;

  bool is_used(std::size_t vertex) const { return used.empty() || used[vertex] != 0; }
};
// Scans a closed star-shaped mesh.
FaceScan scan_faces(const MeshView& mesh, FaceSizes sizes);
FaceScan scan_faces(const MeshView& mesh, const Vec3& center, const Context& context);

}  // namespace rholm
