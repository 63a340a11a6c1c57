// An atlas of fewer degrees. Layer: atlas.
#pragma once

#include "rholm/atlas.h"

namespace rholm {

// The atlas without the coefficients above `degree`; caps then disagree, and the band within which
// they are averaged grows with what they lose. What a cap loses is R_0 sqrt(sum c^2 / 4 pi) rms
// over its opened hemisphere, on which its functions are orthogonal up to l + m odd.
Atlas at_degree(const Atlas& atlas, int degree);
// That loss, rms over all caps by their area.
double lost_at_degree(const Atlas& atlas, int degree);

}  // namespace rholm
