// Checks that every format can hold an expansion. Layer: io, private (and the model file's).
#pragma once

#include <string>

#include "rholm/coefficients.h"

namespace rholm {

// Throws InvalidInput, with `name` and the offending value, unless the expansion is valid. All
// numbers must be finite, S_l0 and the entries m > l zero, and norms not negative. Unit and method
// must be short single lines of UTF-8 without blanks at their ends. A valid expansion reads back
// unchanged from every format that has room for it.
void check_expansion(const Expansion& expansion, const std::string& name);

// Checks the coefficients only.
void check_coefficients(const Coefficients& coefficients, const std::string& name);

}  // namespace rholm
