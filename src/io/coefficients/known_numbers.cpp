#include "io/coefficients/known_numbers.h"

#include "rholm/error.h"

namespace rholm {

KnownNumbers known_numbers(const Expansion& expansion) {
  KnownNumbers numbers{.norm_squared = expansion.norm_squared,
                       .tail_strength = expansion.tail_strength,
                       .precision = expansion.precision};
  if (expansion.gravity) {
    numbers.gravity_constant = expansion.gravity->gravity_constant;
    numbers.reference_radius = expansion.gravity->reference_radius;
  }
  return numbers;
}

void set_known_numbers(const KnownNumbers& numbers, const std::string& name, Expansion& expansion) {
  if (numbers.gravity_constant.has_value() != numbers.reference_radius.has_value()) {
    throw Error(ErrorCode::kInvalidInput,
                name + ": gravity_constant and reference_radius belong together: give both");
  }
  expansion.norm_squared = numbers.norm_squared;
  expansion.tail_strength = numbers.tail_strength;
  expansion.precision = numbers.precision;
  if (numbers.gravity_constant) {
    expansion.gravity = {*numbers.gravity_constant, *numbers.reference_radius};
  }
}

}  // namespace rholm
