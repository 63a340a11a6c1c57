// Open surfaces with clean borders. Layer: surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Cuts away where `support` (one value per vertex) is at most 0, along the line where it is 0 by
// linear interpolation on the edges: of a 2-manifold a 2-manifold with borders is left. The
// support is averaged with its neighbours' `smoothing` times first, so that the border is a smooth
// curve at the scale of the mesh, and the cut is evened out along itself. Cuts keep a tenth of the
// edge from its ends. Attributes are interpolated; vertices in no triangle go. Throws InvalidInput
// if the number of values is not that of the vertices, or one is not finite.
Mesh trim(const Mesh& mesh, std::span<const double> support, int smoothing = 2);

// What is left of a part of a mesh.
struct TrimmedPart {
  Mesh mesh;
  std::vector<std::uint32_t> vertices;   // of the part, that the first ones are; others are new
  std::vector<std::uint32_t> triangles;  // of the part, that each is of
};
// The same in a part: the support of vertices that others' triangles have too, of which there is a
// flag, stays what it is.
TrimmedPart trim_part(const Mesh& mesh, std::span<const double> support,
                      const std::vector<std::uint8_t>& fixed, int smoothing = 2);

}  // namespace rholm
