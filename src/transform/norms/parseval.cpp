#include "transform/norms/parseval.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/compensated_sum.h"
#include "base/rounding.h"
#include "rholm/analyze.h"

namespace rholm {
namespace {

// Norms are compensated sums over faces. The rule of a face may leave an error of 4e-15
// (exact_norms_rules.h), as much as 35 roundings.
constexpr double kNormRounding = rounding_of_sum(35);

double varying_norm(double norm_squared, const Coefficients& coefficients) {
  const double mean = coefficients.c(0, 0);
  return std::sqrt(std::max(0.0, norm_squared - mean * mean));
}

double rms(double energy) { return std::sqrt(std::max(0.0, energy) / (4 * std::numbers::pi)); }

}  // namespace

double precision_of(const Expansion& expansion) {
  return expansion.precision.value_or(AnalyzeOptions{}.precision);
}

double precision_of(double norm_squared, const Coefficients& coefficients,
                    const CoefficientErrors& errors) {
  const double mean = std::abs(coefficients.c(0, 0));
  const double varying = varying_norm(norm_squared, coefficients);
  return std::max(mean > 0 ? errors.mean / mean : 0, varying > 0 ? errors.varying / varying : 0);
}

CoefficientErrors coefficient_errors(double norm_squared, const Coefficients& coefficients,
                                     double mean, double varying) {
  return {.mean = mean * std::abs(coefficients.c(0, 0)),
          .varying = varying * varying_norm(norm_squared, coefficients)};
}

ParsevalRest parseval_rest(double norm_squared, const Coefficients& coefficients,
                           const CoefficientErrors& errors) {
  CompensatedSum rest, varying;
  rest.add(norm_squared);
  const double mean = std::abs(coefficients.c(0, 0));
  for (const double value : coefficients.values()) rest.add(-value * value);
  for (const double value : coefficients.values().subspan(1)) varying.add(value * value);
  const double size = std::sqrt(varying.value());
  return {.value = rest.value(),
          .doubt = 2 * mean * errors.mean + errors.mean * errors.mean + 2 * size * errors.varying +
                   errors.varying * errors.varying + kNormRounding * norm_squared};
}

std::optional<double> rms_of(const ParsevalRest& rest, double least) {
  if (!(rest.value >= least * rest.doubt)) return std::nullopt;
  return rms(rest.value);
}

double rms_doubt(const ParsevalRest& rest) {
  return rms(rest.value) - rms(rest.value - rest.doubt);
}

}  // namespace rholm
