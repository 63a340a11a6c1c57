// Units of length, and the same surface in another one. Layer: harmonic.
#pragma once

#include <optional>
#include <string>

#include "rholm/coefficients.h"

namespace rholm {

// How many metres a unit has, of those that are known: m, its decimal parts and multiples from fm
// to Gm (um and µm), angstrom, in, ft, yd, mi, au; and the English words for them. None for
// any other text. "mm" and "Mm" differ, "KM" is km.
std::optional<double> metres_of(const std::string& unit);

// The surface with all its lengths times `factor`, finite and above 0: coefficients, centre, norm
// and errors. The unit's name is the caller's. Throws InvalidInput for another factor.
Expansion scaled(const Expansion& expansion, double factor);

}  // namespace rholm
