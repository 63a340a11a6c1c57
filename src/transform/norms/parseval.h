// What the degrees of a function beyond those that are known hold, as the difference of its norm
// and theirs, (M7), and how far that can be trusted.
#pragma once

#include <optional>

#include "rholm/coefficients.h"

namespace rholm {

// Of the coefficients, absolute: of c_00, and the l2 norm of that of all others.
struct CoefficientErrors {
  double mean = 0, varying = 0;
};
// That of the coefficients, or what it is assumed to be: the default of AnalyzeOptions.
double precision_of(const Expansion& expansion);
// The larger of both errors, relative: the inverse of what follows.
double precision_of(double norm_squared, const Coefficients& coefficients,
                    const CoefficientErrors& errors);
// From relative ones: of c_00, and of the function without its mean.
CoefficientErrors coefficient_errors(double norm_squared, const Coefficients& coefficients,
                                     double mean, double varying);

struct ParsevalRest {
  double value = 0;  // ||f||^2 - sum |c|^2; may be below 0 where the doubt is larger
  // How far the rest is at most from that of exact coefficients: 2 |c| |dc| + |dc|^2, for c_00 and
  // for the others by Cauchy and Schwarz, and the rounding of the norms.
  double doubt = 0;
};
ParsevalRest parseval_rest(double norm_squared, const Coefficients& coefficients,
                           const CoefficientErrors& errors);

// sqrt(rest / 4 pi), if the rest is at least this many times its doubt.
std::optional<double> rms_of(const ParsevalRest& rest, double least);
// Where a rest that is at least 4 times its doubt is believed: 13 % of its root at most.
inline constexpr double kBelieved = 4;
// How far sqrt(rest / 4 pi) of a rest above its doubt may be off.
double rms_doubt(const ParsevalRest& rest);

}  // namespace rholm
