// What a model file holds of a reconstruction beside its atlas: the caps to the bit, and how the
// surface is made of them. Layer: reconstruct, private.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rholm/atlas.h"
#include "rholm/surface_rules.h"

namespace rholm {

// Numbers of a cap: centre, axes x, y, z, radius, dilation, support; px, py, xx, xy, yy of the
// ellipse; error, area, weight, deviation.
inline constexpr std::size_t kExactCap = 24;
// Of a place where the spacing is known: its coordinates, then the spacing.
inline constexpr std::size_t kSpacingNumbers = 4;

struct PackedRules {
  std::vector<double> caps;          // [caps][kExactCap]
  std::vector<double> coefficients;  // of all caps, in their order
  std::vector<double> spacings;      // [places][kSpacingNumbers]
  std::vector<std::uint8_t> seen;    // SeenCubes::bits; empty without
};

PackedRules pack_rules(const Atlas& atlas, const SurfaceRules& rules);

// Puts them into an atlas with the same caps, and into rules whose `seen` has its frame. Throw
// InvalidInput (`name` is the file) for what cannot be: sizes that disagree, numbers that are not
// finite, axes that are no frame.
void unpack_caps(const PackedRules& packed, const std::string& name, Atlas& atlas);
void unpack_rules(PackedRules packed, const std::string& name, SurfaceRules& rules);

// Over the bytes of the datasets, in the order of PackedRules, then of the names of what is left
// out.
std::uint32_t rules_crc32(const PackedRules& packed, const std::vector<std::string>& left_out);

}  // namespace rholm
