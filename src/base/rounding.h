// Bounds rounding errors of sums in double precision. Layer: base.
#pragma once

#include <limits>

namespace rholm {

// The largest relative error of one operation, half a unit in the last place: 1.1e-16.
inline constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2;

// Returns a bound on the error of a sum, relative to the sum of the moduli of its terms. A term
// from `per_term` = k operations has the error (1 + u)^k - 1, k u to first order; the result has u.
// Plain sums have larger errors, which grow with the number of terms. The bound holds for
// compensated sums (compensated_sum.h: n u^2 more, below a hundredth of u up to 10^13 terms). It
// also holds for terms that are whole multiples of a quantum, which add up exactly.
constexpr double rounding_of_sum(double per_term) { return (per_term + 1) * kUnitRoundoff; }

}  // namespace rholm
