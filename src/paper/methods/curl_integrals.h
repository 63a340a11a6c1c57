// The integrals K_m of the corrected vector field, (M2)-(M3).
#pragma once

#include <complex>
#include <span>

namespace rholm {

// Computes K_m = int_0^psi e^{-i m t} / (C + rho cos t) dt for m = 0 ... out.size() - 1. Requires
// C + rho cos t > 0 between 0 and psi and rho >= 0; psi may exceed +-pi if C > rho. `end_value` is
// C + rho cos psi, which the caller knows more precisely (d_T/|x|) than the sum gives it. Relative
// error about 1e-14 of |K_0|.
void curl_integrals(double C, double rho, double psi, double end_value,
                    std::span<std::complex<double>> out);

// Returns K_0 alone.
double curl_integral_of_order_zero(double C, double rho, double psi, double end_value);

}  // namespace rholm
