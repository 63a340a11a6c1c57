// The gradient of a harmonic expansion as three expansions one degree lower.
//
// The solid harmonics r^l Y_lm are polynomials whose Cartesian derivatives are solid harmonics of
// degree l - 1 (Hobson 1931, art. 82 ff.). For complex orthonormal Y_lm with Condon-Shortley
// phase and q = (2l+1)/(2l-1):
//   d/dz            (r^l Y_lm) =  sqrt(q (l^2 - m^2))     r^{l-1} Y_{l-1,m}
//   (d/dx + i d/dy) (r^l Y_lm) =  sqrt(q (l-m)(l-m-1))    r^{l-1} Y_{l-1,m+1}
//   (d/dx - i d/dy) (r^l Y_lm) = -sqrt(q (l+m)(l+m-1))    r^{l-1} Y_{l-1,m-1}
// There is no division by sin theta, so the poles are ordinary points. The surface gradient is the
// tangential part at r = 1.
#pragma once

#include <array>

#include "rholm/coefficients.h"

namespace rholm {

// Returns {D_x f, D_y f, D_z f}, the coefficients of the derivatives of sum_lm c_lm r^l Y_lm at
// r = 1. They are padded with zeros to the degree of f, so that they can be summed together with f.
std::array<Coefficients, 3> solid_gradient(const Coefficients& f);

// Adds the transpose D_x^T g_x + D_y^T g_y + D_z^T g_z to `sum`; all have the same degree.
void add_solid_gradient_transpose(const std::array<Coefficients, 3>& g, Coefficients& sum);

}  // namespace rholm
