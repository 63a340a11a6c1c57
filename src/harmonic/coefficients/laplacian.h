// The inverse of the Laplacian of the sphere.
#pragma once

#include "rholm/coefficients.h"

namespace rholm {

// Divides the coefficients of each degree l >= 1 by l(l+1), the factor of the Laplacian of the
// sphere. Sets c_00, which the Laplacian removes, to 0.
void divide_by_eigenvalue(Coefficients& c);

}  // namespace rholm
