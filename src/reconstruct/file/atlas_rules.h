// The caps of a reconstruction to the bit, and the rules that make its surface of them: a model
// file holds both beside the atlas. Layer: reconstruct, private.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rholm/atlas.h"
#include "rholm/surface_rules.h"

namespace rholm {

// Number of values of a cap: centre, axes x, y, z, radius, dilation, support; px, py, xx, xy, yy of
// the ellipse; error, area, weight, deviation.
inline constexpr std::size_t kExactCap = 24;
// Number of values of a place with a known spacing: its coordinates, then the spacing.
inline constexpr std::size_t kSpacingNumbers = 4;

struct PackedRules {
  std::vector<double> caps;          // [caps][kExactCap]
  std::vector<double> coefficients;  // of all caps, in their order
  std::vector<double> spacings;      // [places][kSpacingNumbers]
  std::vector<std::uint8_t> seen;    // SeenCubes::bits; empty without
};

PackedRules pack_rules(const Atlas& atlas, const SurfaceRules& rules);

// Puts the values into an atlas with the same caps, and into rules whose `seen` has its frame. Both
// throw InvalidInput for impossible data: sizes that disagree, numbers that are not finite, axes
// that are no frame. `name` is the file.
void unpack_caps(const PackedRules& packed, const std::string& name, Atlas& atlas);
void unpack_rules(PackedRules packed, const std::string& name, SurfaceRules& rules);

// Returns the checksum of the bytes of the datasets, in the order of PackedRules, then of the names
// in `left_out`.
std::uint32_t rules_crc32(const PackedRules& packed, const std::vector<std::string>& left_out);

}  // namespace rholm
