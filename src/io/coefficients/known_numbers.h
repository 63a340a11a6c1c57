// Named numbers that files store with an expansion, with the same names in every format. Layer: io,
// private.
#pragma once

#include <optional>
#include <string>

#include "rholm/coefficients.h"

namespace rholm {

// The numbers of a file; a number is empty if the file does not have it.
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
// Does the inverse. Throws InvalidInput if only one of gravity constant and reference radius is
// given. `name` is the name of the file.
void set_known_numbers(const KnownNumbers& numbers, const std::string& name, Expansion& expansion);

}  // namespace rholm
