// Samplers: edges by the field, triangles by r conj(Y).
#pragma once

#include <cstddef>
#include <cstdint>

#include "paper/monte_carlo/edge_terms.h"
#include "paper/monte_carlo/moments.h"
#include "transform/geometry/star_geometry.h"

namespace rholm {

struct Sampler {
  std::size_t places = 0;
  DrawSample draw;
};

// Returns a sampler that is uniform along the flat edge, (P40).
Sampler edge_sampler(const StarGeometry& geometry, std::uint64_t seed, FieldStart start);
// Returns a sampler that is uniform on the spherical triangle.
Sampler triangle_sampler(const StarGeometry& geometry, std::uint64_t seed);

}  // namespace rholm
