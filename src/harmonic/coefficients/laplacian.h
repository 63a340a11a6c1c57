// The Laplacian of the sphere undone.
#pragma once

#include "rholm/coefficients.h"

namespace rholm {

// Divides the degrees l >= 1 by l(l+1), which the Laplacian of the sphere has multiplied them by;
// c_00, which it has lost, becomes 0.
void divide_by_eigenvalue(Coefficients& c);

}  // namespace rholm
