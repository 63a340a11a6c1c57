// Between two expansions. Layer: studio.
#pragma once

#include "rholm/coefficients.h"

namespace rholm::studio {

// (1 - t) a + t b, coefficient by coefficient, and centres likewise; degrees that one has not are
// zero there. t from 0 to 1 goes from a to b, beyond it exaggerates. Throws InvalidInput if their
// functions differ, or t is not within -1 ... 2.
Expansion blended(const Expansion& a, const Expansion& b, double t);

}  // namespace rholm::studio
