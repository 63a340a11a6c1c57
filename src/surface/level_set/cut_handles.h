// Bridges and tunnels that are smaller than points can tell (method 7.9).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

// The distance at which points, or a grid, tell one place from another.
struct Resolution {
  double typical = 0;
  std::function<double(const Vec3&)> at;  // asked by several threads
};

struct CutHandles {
  std::size_t handles = 0;
  std::vector<std::uint32_t> copies;  // of which vertices the mesh's last ones are copies
};

// Cuts a closed surface with normals nx, ny, nz where a loop of at most five resolutions goes
// around or through something, if the surface opens on both sides of it within three: bridges
// between sheets, holes through thin ones. Rods and their like stay, and the parts stay whole. Both
// ends are closed and made smooth; normals there are zero.
CutHandles cut_handles(Mesh& mesh, const Resolution& resolution, const Context& context);

}  // namespace rholm
