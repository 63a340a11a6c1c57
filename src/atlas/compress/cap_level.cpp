#include "atlas/compress/cap_level.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rholm {
namespace {

// Standard deviations of the difference of two averaged caps: covers nearly all differences.
constexpr double kDisagree = 3;

// Returns the rms over the cap of the coefficients from `first` on.
double lost(const Cap& cap, std::span<const double> coefficients, std::size_t first) {
  double sum = 0;
  for (std::size_t i = first; i < coefficients.size(); ++i)
    sum += coefficients[i] * coefficients[i];
  return cap.frame.radius * std::sqrt(sum / (4 * std::numbers::pi));
}

}  // namespace

double lost_at_degree(const Atlas& atlas, int degree) {
  double squares = 0, areas = 0;
  for (const Cap& cap : atlas.caps) {
    const int left = std::min<int>(cap.degree, degree);
    const double rms = lost(cap, atlas.coefficients_of(cap), n_coefficients(cap.basis, left));
    const double area = cap.frame.support * cap.frame.support;
    squares += area * rms * rms, areas += area;
  }
  return areas > 0 ? std::sqrt(squares / areas) : 0;
}

Atlas at_degree(const Atlas& atlas, int degree) {
  Atlas level = atlas;
  for (Cap& cap : level.caps)
    cap.degree = static_cast<std::uint16_t>(std::min<int>(cap.degree, degree));
  level.band = std::max(level.band, kDisagree * std::sqrt(2.0) * lost_at_degree(atlas, degree));
  return level;
}

}  // namespace rholm
