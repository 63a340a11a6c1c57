// What double precision leaves of a sum. Layer: base.
#pragma once

#include <limits>

namespace rholm {

// The largest relative error of one operation, half a unit in the last place: 1.1e-16.
inline constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2;

// Of a sum, relative to the sum of the moduli of its terms, each of which is the outcome of
// `per_term` operations: (1 + u)^k - 1 of each, k u to first order, and one rounding of the result.
// Not of a plain sum, whose rounding grows with the number of its terms: of one that is compensated
// (compensated_sum.h: n u^2 more, below a hundredth of u up to 10^13 terms), or of terms that are
// whole multiples of a quantum, which add up exactly.
constexpr double rounding_of_sum(double per_term) { return (per_term + 1) * kUnitRoundoff; }

}  // namespace rholm
