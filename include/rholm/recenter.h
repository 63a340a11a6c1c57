// The same surface as seen from another centre. Layer: harmonic.
#pragma once

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// Of the solid within the surface, in the coordinates of its centre; exact for a radius. Throws
// InvalidInput for a gauge that is not positive, or a solid without volume.
Vec3 volume_centroid(const Expansion& expansion, const Context& context = {});

// The expansion about `center` of the surface, of the same degree: by Newton's iteration along
// rays to the nodes of a Gauss-Legendre grid of twice the degree. What the turn of the centre takes
// to degrees above is lost; what was known of norm and errors is dropped. O(L^3). Throws
// NotStarShaped where the surface, on that grid, turns its back to the new centre, InvalidInput for
// a surface that is not star-shaped about its own centre (r <= 0).
Expansion recentered(const Expansion& expansion, const Vec3& center, const Context& context = {});

}  // namespace rholm
