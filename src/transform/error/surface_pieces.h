// Cuts a mesh into pieces that are small in area and as seen from the centre. Their points give
// root mean squares over steep surfaces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/mesh_view.h"

namespace rholm {

struct SurfacePieces {
  std::vector<Vec3> directions;  // direction of a point on each piece
  std::vector<double> radii;     // distance of the point, times `scale`
  std::vector<double> cosines;   // cos gamma of its face
  std::vector<double> areas;     // area that it stands for, times scale^2
  std::vector<std::int64_t> faces;
  double scale = 1;  // a power of two that brings lengths near 1

  std::size_t size() const { return directions.size(); }
};

// Halves faces until no piece has more than 2/n of the area and the solid angle together. If there
// are more than n faces, takes random pieces, in proportion to both. Returns at most 2n points and
// one for each of at most n faces, the same bits every time.
SurfacePieces surface_pieces(const MeshView& mesh, const Vec3& center, std::size_t n);

}  // namespace rholm
