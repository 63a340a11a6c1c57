// Blends two expansions. Layer: studio.
#pragma once

#include "rholm/coefficients.h"

namespace rholm::studio {

// Returns (1 - t) a + t b for coefficients and centres; missing degrees
// count as zero. t from 0 to 1 goes from a to b; other values exaggerate.
// Throws InvalidInput if the functions differ, or t is not within -1 ... 2.
Expansion blended(const Expansion& a, const Expansion& b, double t);

}  // namespace rholm::studio
