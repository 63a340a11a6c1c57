// Where a surface turns around within a length. Layer: surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

// The values of the attributes nx, ny, nz, which the mesh has.
using NormalAxes = std::array<std::vector<double>*, 3>;
NormalAxes normal_axes(Mesh& mesh);

// Vertices, ascending, of which every closed curve on the surface of at most that length that is
// the shortest around something passes one, more or less: found by normals nx, ny, nz.
std::vector<std::uint32_t> tight_places(Mesh& mesh, double length, const Context& context);

}  // namespace rholm
