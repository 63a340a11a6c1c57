// Potential and surface of a cap at many points. Layer: atlas.
#pragma once

#include <span>

#include "atlas/cap/cap_fit.h"
#include "rholm/atlas.h"

namespace rholm {

// The potential g of atlas.h at the points of `points` (offsets from the seed; their normals and
// weights are not looked at), in distance[0 ... points.padded). NaN where the cap has none: behind
// the centre, and where r(u) <= 0.
void cap_distances(const Cap& cap, std::span<const double> coefficients, const CapPoints& points,
                   std::span<double> distance);

// Points of the cap's surface in the directions of those offsets from the seed, relative to the
// seed, and the normals there; three rows of points.padded() each. NaN as above.
void cap_surface(const Cap& cap, std::span<const double> coefficients, const CapPoints& points,
                 std::span<double> positions, std::span<double> normals);

}  // namespace rholm
