// An atlas in few bytes: what the model file keeps of it. Layer: reconstruct, private.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rholm/atlas.h"

namespace rholm {

// Number of values of a cap. The frame has seed relative to the origin, rotation vector of the
// axes, radius, dilation and support. Then follow the step and the error; a coefficient is its
// integer times the step.
inline constexpr std::size_t kPackedCap = 11;

struct PackedAtlas {
  Vec3 origin;
  double spacing = 0, noise = 0, diagonal = 0, band = 0;
  CapBasis basis = CapBasis::kFull;
  CapBlend blend = CapBlend::kSmooth;
  double weight_power = 0;      // weights are (largest support / support)^power ...
  std::vector<float> caps;      // [caps][kPackedCap]
  std::vector<float> ellipses;  // [caps][5] as CapSupport; empty: all are the circle of support
  std::vector<float> weights;   // ... unless they are here: [caps], or empty
  std::vector<std::uint8_t> degrees;  // [caps]
  std::vector<std::uint8_t> kept;     // one bit per coefficient, lowest bit first; 0: it is zero
  std::vector<std::int16_t> values;   // of the kept ones
};

// Rounds frames to 24 bits, coefficients to 1/32767 of a cap's largest one: below 1e-4 of the cap's
// fit in all that has been measured. Throws InvalidInput for caps of different bases.
PackedAtlas pack(const Atlas& atlas);

// Throws InvalidInput for data that no atlas can have: sizes that disagree, numbers that are not
// finite, degrees too high. `name` is the file. Without `deviations` the deviations of the caps are
// 0; computing them takes most of the time.
Atlas unpack(const PackedAtlas& packed, const std::string& name, bool deviations = true);

// Returns the largest distance of a cap's surface within its support from the tangent plane.
double deviation_of(const Cap& cap, std::span<const double> coefficients);

}  // namespace rholm
