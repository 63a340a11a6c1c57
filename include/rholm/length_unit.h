// Units of length, and scaling of a surface to another unit. Layer: harmonic.
#pragma once

#include <optional>
#include <string>

#include "rholm/coefficients.h"

namespace rholm {

// Returns the length of a known unit in metres: m with decimal prefixes from fm to Gm (um and µm),
// angstrom, in, ft, yd, mi, au, and their English words. Returns nothing for any other text. "mm"
// and "Mm" differ, "KM" is km.
std::optional<double> metres_of(const std::string& unit);

// Returns the surface with all lengths times `factor`, finite and above 0: coefficients, centre,
// norm and errors. The caller sets the unit's name. Throws InvalidInput for another factor.
Expansion scaled(const Expansion& expansion, double factor);

}  // namespace rholm
