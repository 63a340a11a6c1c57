// Energy of a function beyond the known degrees, and its error bound. The energy is the squared
// norm less the energy of the known degrees, (M7).
#pragma once

#include <optional>

#include "rholm/coefficients.h"

namespace rholm {

// Absolute errors: of c_00, and the l2 norm of the errors of all other coefficients.
struct CoefficientErrors {
  double mean = 0, varying = 0;
};
// Returns the precision of the coefficients or, if it is unknown, the default of AnalyzeOptions.
double precision_of(const Expansion& expansion);
// Returns the larger one of the two errors, both relative: the inverse of coefficient_errors().
double precision_of(double norm_squared, const Coefficients& coefficients,
                    const CoefficientErrors& errors);
// Converts relative errors: `mean` of c_00, `varying` of the function without its mean.
CoefficientErrors coefficient_errors(double norm_squared, const Coefficients& coefficients,
                                     double mean, double varying);

struct ParsevalRest {
  double value = 0;  // ||f||^2 - sum |c|^2; negative at most by `doubt`
  // Bound on the difference from the rest of exact coefficients: 2 |c| |dc| + |dc|^2 for c_00 and,
  // by Cauchy and Schwarz, for the other coefficients. It includes the rounding of the norms.
  double doubt = 0;
};
ParsevalRest parseval_rest(double norm_squared, const Coefficients& coefficients,
                           const CoefficientErrors& errors);

// Returns sqrt(rest / 4 pi) if the rest is at least `least` times its error bound.
std::optional<double> rms_of(const ParsevalRest& rest, double least);
// A rest is reported from 4 times its error bound on: its root is then off by 13 % at most.
inline constexpr double kBelieved = 4;
// Returns the largest error of sqrt(rest / 4 pi), for a rest above its error bound.
double rms_doubt(const ParsevalRest& rest);

}  // namespace rholm
