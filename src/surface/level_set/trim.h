// Cuts surfaces open with clean borders. Layer: surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Removes the surface where `support` (one value per vertex) is at most 0. It cuts along
// the zero line of linear interpolation; a 2-manifold stays a 2-manifold with borders.
// First the support is averaged `smoothing` times with its neighbours, so that the border
// is smooth at the mesh's scale. Then the cut is smoothed along itself. Cuts keep a tenth
// of the edge from its ends. Attributes are interpolated; vertices without triangles are
// removed. Throws InvalidInput for a wrong number of values, or a value that is not finite.
Mesh trim(const Mesh& mesh, std::span<const double> support, int smoothing = 2);

// Remainder of a part of a mesh.
struct TrimmedPart {
  Mesh mesh;
  std::vector<std::uint32_t> vertices;  // source vertices of the first ones; others are new
  std::vector<std::uint32_t> faces;     // source triangle of each triangle
};
// Acts as trim() on a part of a mesh. `fixed` flags the vertices
// whose support stays unchanged, because other parts share them.
TrimmedPart trim_part(const Mesh& mesh, std::span<const double> support,
                      const std::vector<std::uint8_t>& fixed, int smoothing = 2);

}  // namespace rholm
