// Evaluates potential and surface of a cap at many points. Layer: atlas.
#pragma once

#include <span>

#include "atlas/cap/cap_fit.h"
#include "rholm/atlas.h"

namespace rholm {

// Computes the potential g of atlas.h in distance[0 ... points.padded). The points
// are offsets from the seed; their normals and weights are ignored. The result is
// NaN where the cap has no potential: behind the centre, and where r(u) <= 0.
void cap_distances(const Cap& cap, std::span<const double> coefficients, const CapPoints& points,
                   std::span<double> distance);

// Computes points of the cap's surface in the directions of the offsets, relative to the
// seed, and the normals there. Each has three rows of points.padded() values, NaN as above.
void cap_surface(const Cap& cap, std::span<const double> coefficients, const CapPoints& points,
                 std::span<double> positions, std::span<double> normals);

}  // namespace rholm
