// Change of the centre of an expansion. Layer: harmonic.
#pragma once

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// Returns the centroid of the solid, in the coordinates of the expansion's centre; exact for a
// radius. Throws InvalidInput for a gauge that is not positive, or a solid without volume,
// Unsupported for a signed sum.
Vec3 volume_centroid(const Expansion& expansion, const Context& context = {});

// Returns `wanted` if recentered() accepts it. Otherwise returns a point between the expansion's
// centre and `wanted`, far enough inside all tangent planes that recentered() accepts it. Throws as
// recentered(), except NotStarShaped.
Vec3 seen_center(const Expansion& expansion, const Vec3& wanted, const Context& context = {});

// Returns the surface expanded about `center`, with the same degree, by Newton's
// iteration along rays to the nodes of a Gauss-Legendre grid of twice the degree;
// O(L^3). Degrees above are lost, and norm and errors are dropped. Where ripples
// of the series fold back by less than 2 % of the distance, one of the sides is
// used. Throws NotStarShaped if the surface on that grid folds back further as
// seen from the new centre. Throws Unsupported for a signed sum, InvalidInput for
// a surface that is not star-shaped about its own centre (r <= 0).
Expansion recentered(const Expansion& expansion, const Vec3& center, const Context& context = {});

}  // namespace rholm
