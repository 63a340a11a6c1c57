// One way through the faces of a mesh for what the choice of points on it wants to know.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh_view.h"

namespace rholm {

struct FaceScan {
  // Faces t are taken in runs of this many: few enough to find one by its share of the area, many
  // enough for sums of all runs to take little memory (chosen).
  static constexpr std::size_t kRun = 16;

  // A power of two that brings lengths near 1, so that areas and their squares are in range. It
  // rounds nothing.
  double scale = 1;
  std::vector<double> twice_areas;  // of each run, of lengths times `scale`
  // Of each run: the square of the longest edge over that of the nearest corner's distance from
  // the centre, at least the largest of that of each edge and its own ends.
  std::vector<double> angles2;
  // Of each vertex, 1 if it belongs to a face; a vertex of no face is no point of the surface.
  std::vector<std::uint8_t> used;
};
FaceScan scan_faces(const MeshView& mesh, const Vec3& center, const Context& context);

}  // namespace rholm
