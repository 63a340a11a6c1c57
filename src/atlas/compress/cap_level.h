// Reduces the degree of an atlas. Layer: atlas.
#pragma once

#include "rholm/atlas.h"

namespace rholm {

// Returns the atlas without coefficients above `degree`. Its caps differ, so the band in
// which they are averaged grows with the loss. The loss of a cap is R_0 sqrt(sum c^2 / 4 pi)
// rms over its opened hemisphere, where its functions are orthogonal except for odd l + m.
Atlas at_degree(const Atlas& atlas, int degree);
// Returns this loss as the rms over all caps, weighted by area.
double lost_at_degree(const Atlas& atlas, int degree);

}  // namespace rholm
