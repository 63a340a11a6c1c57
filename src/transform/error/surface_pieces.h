// A mesh in pieces that are small both in area and as seen from the centre: points for root mean
// squares over steep surfaces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/mesh_view.h"

namespace rholm {

struct SurfacePieces {
  std::vector<Vec3> directions;  // of a point on each, from the centre
  std::vector<double> radii;     // its distance, times `scale`
  std::vector<double> cosines;   // of its face
  std::vector<double> areas;     // that it stands for, times scale^2
  std::vector<std::int64_t> faces;
  double scale = 1;  // a power of two that brings lengths near 1

  std::size_t size() const { return directions.size(); }
};

// Faces are halved until no piece has more than 2/n of the area and the solid angle together; of
// meshes with more than n faces some are taken by chance, in proportion to both. At most 2n points
// and one for each of at most n faces. The same bits every time.
SurfacePieces surface_pieces(const MeshView& mesh, const Vec3& center, std::size_t n);

}  // namespace rholm
