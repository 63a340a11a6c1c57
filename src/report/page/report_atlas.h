// Figures of an atlas in a report, before they become text.
#pragma once

#include <cstddef>
#include <vector>

#include "rholm/atlas.h"

namespace rholm::report {

// Returns the degree limits of the drawn surfaces: a quarter of the highest, half of it, all.
std::vector<int> drawn_limits(const Atlas& atlas);
// Returns the number of coefficients with degrees up to a limit that are not zero.
std::size_t coefficients_up_to(const Atlas& atlas, int degree);
// Returns what each degree adds to r(u) - R_0, in the unit of lengths. The value is
// the rms over the whole sphere of a cap, and over the caps weighted by their area.
std::vector<double> cap_heights_by_degree(const Atlas& atlas);

}  // namespace rholm::report
