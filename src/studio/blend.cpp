#include "studio/blend.h"

#include <algorithm>

#include <fmt/format.h>

#include "rholm/error.h"

namespace rholm::studio {

Expansion blended(const Expansion& a, const Expansion& b, double t) {
  if (!(t >= -1 && t <= 2)) {
    throw Error(ErrorCode::kInvalidInput, fmt::format("t must be within -1 ... 2, not {}", t));
  }
  if (a.function != b.function) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("a {} and a {} cannot be blended: expand both in the same way",
                            to_string(a.function), to_string(b.function)));
  }
  const int degree = std::max(a.coefficients.degree(), b.coefficients.degree());
  Expansion blend = {.coefficients = a.coefficients.resized(degree),
                     .function = a.function,
                     .center = (1 - t) * a.center + t * b.center,
                     .unit = a.unit,
                     .method = "blend"};
  const Coefficients other = b.coefficients.resized(degree);
  const std::span<double> values = blend.coefficients.values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = (1 - t) * values[i] + t * other.values()[i];
  }
  return blend;
}

}  // namespace rholm::studio
