#include "rholm/rms_beyond.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "transform/norms/parseval.h"

namespace rholm {
namespace {

// An rms by Parseval is called exact where its error bound is at most a fiftieth of the rest
// (truncation.cpp).
constexpr double kExact = 50;

double rms_of_energy(double energy) {
  return std::sqrt(std::max(0.0, energy) / (4 * std::numbers::pi));
}

double doubt_of(const Expansion& expansion, const ParsevalRest& rest) {
  const std::optional<TruncationErrors>& errors = expansion.errors;
  if (!errors || !errors->rms || expansion.function != RadialFunction::kRadius) return rest.doubt;
  if (errors->rms_is_exact) return std::min(rest.doubt, std::abs(rest.value) / kExact);
  const double measured = 4 * std::numbers::pi * *errors->rms * *errors->rms;
  return std::max(rest.doubt, std::abs(rest.value - measured));
}

}  // namespace

RmsBeyond rms_beyond(const Expansion& expansion) {
  const std::vector<double> energy = power_spectrum(expansion.coefficients);
  RmsBeyond result;
  result.precision = precision_of(expansion);
  result.precision_is_assumed = !expansion.precision;
  result.rms.resize(energy.size());
  result.rms_within.resize(energy.size());
  // The sum begins at the top, so that small remainders are not lost against the large first
  // degrees.
  double within = 0;
  for (std::size_t l = energy.size(); l-- > 0;) {
    result.rms_within[l] = rms_of_energy(within);
    within += energy[l];
  }
  if (!expansion.norm_squared) return result;
  const double norm_squared = *expansion.norm_squared;
  ParsevalRest rest = parseval_rest(
      norm_squared, expansion.coefficients,
      coefficient_errors(norm_squared, expansion.coefficients, result.precision, result.precision));
  rest.doubt = doubt_of(expansion, rest);
  result.doubt = rest.doubt;
  for (std::size_t l = energy.size(); l-- > 0;) {
    result.rms[l] = rms_of(rest, kBelieved);
    rest.value += energy[l];
  }
  return result;
}

std::vector<std::optional<double>> RmsBeyond::figures() const {
  if (includes_tail()) return rms;
  std::vector<std::optional<double>> within(rms_within.begin(), rms_within.end());
  within.back().reset();
  return within;
}

bool RmsBeyond::is_exact(int l) const {
  const std::optional<double>& value = rms[static_cast<std::size_t>(l)];
  return value && 4 * std::numbers::pi * *value * *value >= kExact * *doubt;
}

// A rest that is not reported is below kBelieved error bounds; the true rest may be one bound
// larger.
std::optional<double> RmsBeyond::bound() const {
  if (!doubt) return std::nullopt;
  return rms_of_energy((kBelieved + 1) * *doubt);
}

std::optional<int> RmsBeyond::degree_within(double tolerance) const {
  const std::optional<double> most = bound();
  for (std::size_t l = 0; l < rms.size(); ++l) {
    const std::optional<double>& value = rms[l] ? rms[l] : most;
    if (value && *value <= tolerance) return static_cast<int>(l);
  }
  return std::nullopt;
}

}  // namespace rholm
