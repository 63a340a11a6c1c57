// The same surface as seen from another centre. Layer: harmonic.
#pragma once

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// Of the solid within the surface, in the coordinates of its centre; exact for a radius. Throws
// InvalidInput for a gauge that is not positive, or a solid without volume, Unsupported for a
// signed sum.
Vec3 volume_centroid(const Expansion& expansion, const Context& context = {});

// `wanted` if recentered() accepts it, else a point on the way to it from the centre of the
// expansion that is well within all planes that touch the surface, so that recentered() accepts
// that. Throws as recentered() does, but never NotStarShaped.
Vec3 seen_center(const Expansion& expansion, const Vec3& wanted, const Context& context = {});

// The expansion about `center` of the surface, of the same degree: by Newton's iteration along
// rays to the nodes of a Gauss-Legendre grid of twice the degree. What the turn of the centre takes
// to degrees above is lost; what was known of norm and errors is dropped. O(L^3). Ripples of a
// series that fold back by less than 2 % of the distance are seen as one of their sides. Throws
// NotStarShaped where the surface, on that grid, turns its back to the new centre by more,
// Unsupported for a signed sum, InvalidInput for a surface that is not star-shaped about its own
// centre (r <= 0).
Expansion recentered(const Expansion& expansion, const Vec3& center, const Context& context = {});

}  // namespace rholm
