// Is an expansion one that every format can hold? Layer: io, private (and the model file's).
#pragma once

#include <string>

#include "rholm/coefficients.h"

namespace rholm {

// Throws InvalidInput, with `name` and the offending value, unless all numbers are finite, S_l0
// and the places m > l are zero, the norms are not negative, and unit and method are
// short single lines of UTF-8 without blanks at their ends. What passes reads back
// the same from every format that has room for it.
void check_expansion(const Expansion& expansion, const std::string& name);

// The coefficients alone.
void check_coefficients(const Coefficients& coefficients, const std::string& name);

}  // namespace rholm
