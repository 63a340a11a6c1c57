#include "harmonic/rings/half_rings.h"

#include <algorithm>
#include <cmath>

namespace rholm {
namespace {

// Replaces log2(sin theta) at a pole: so low that no factor l^m < 2^(15 m) compensates it.
constexpr double kLog2OfPole = -1e5;
// Keeps so few bits of log2_sin that its product with an order below 2^15 has 53 bits.
constexpr double kSplit = 0x1p15 + 1;

}  // namespace

HalfRings::HalfRings(std::span<const double> north_colatitudes)
    : size(north_colatitudes.size()),
      padded((size + kRingBlock - 1) / kRingBlock * kRingBlock),
      cos_theta(padded),
      sin_theta(padded),
      cos2(padded),
      sin2(padded),
      log2_sin(padded),
      log2_sin_rest(padded),
      largest_sin(padded / kRingGroup),
      least_sin(padded / kRingBlock),
      least_cos(padded / kRingBlock) {
  for (std::size_t i = 0; i < padded; ++i) {
    const long double theta = north_colatitudes[std::min(i, size - 1)];
    const long double x = std::max(std::cos(theta), 0.0L), s = std::sin(theta);
    cos_theta[i] = static_cast<double>(x);
    sin_theta[i] = static_cast<double>(s);
    cos2[i] = static_cast<double>(x * x);
    sin2[i] = static_cast<double>(s * s);
    const long double logarithm = s > 0 ? std::log2(s) : kLog2OfPole;
    const double rounded = static_cast<double>(logarithm);
    log2_sin[i] = rounded * kSplit - (rounded * kSplit - rounded);  // Veltkamp's splitting
    log2_sin_rest[i] = static_cast<double>(logarithm - log2_sin[i]);
  }
  for (std::size_t i = 0; i < padded; i += kRingGroup) {
    largest_sin[i / kRingGroup] = *std::max_element(&sin_theta[i], &sin_theta[i] + kRingGroup);
  }
  for (std::size_t i = 0; i < padded; i += kRingBlock) {
    least_sin[i / kRingBlock] = *std::min_element(&sin_theta[i], &sin_theta[i] + kRingBlock);
    least_cos[i / kRingBlock] = *std::min_element(&cos_theta[i], &cos_theta[i] + kRingBlock);
  }
}

}  // namespace rholm
