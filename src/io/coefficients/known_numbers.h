// Numbers that files say of an expansion by their names, the same in every format. Layer: io,
// private.
#pragma once

#include <optional>
#include <string>

#include "rholm/coefficients.h"

namespace rholm {

// What a file does not say is empty.
struct KnownNumbers {
  std::optional<double> norm_squared = {}, tail_strength = {};
  std::optional<double> gravity_constant = {}, reference_radius = {};
  std::optional<double> precision = {};
};

struct KnownNumber {
  const char* name;
  std::optional<double> KnownNumbers::*value;
};
inline constexpr KnownNumber kKnownNumbers[] = {
    {"norm_squared", &KnownNumbers::norm_squared},
    {"tail_strength", &KnownNumbers::tail_strength},
    {"gravity_constant", &KnownNumbers::gravity_constant},
    {"reference_radius", &KnownNumbers::reference_radius},
    {"precision", &KnownNumbers::precision},
};

KnownNumbers known_numbers(const Expansion& expansion);
// The inverse. Throws InvalidInput for a gravity constant without a reference radius, or the other
// way round; `name` is that of the file.
void set_known_numbers(const KnownNumbers& numbers, const std::string& name, Expansion& expansion);

}  // namespace rholm
