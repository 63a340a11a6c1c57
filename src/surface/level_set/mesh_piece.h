// A part of a mesh as a mesh of its own. Layer: surface.
#pragma once

#include <cstdint>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

struct MeshPiece {
  Mesh mesh;                                       // without attributes
  std::vector<std::uint32_t> vertices, triangles;  // of the whole mesh, ascending
};

// All triangles within `reach` of some vertices, and some more.
MeshPiece piece_around(const Mesh& mesh, const std::vector<std::uint32_t>& centers, double reach,
                       const Context& context);

}  // namespace rholm
