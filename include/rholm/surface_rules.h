// Rules for extracting a reconstruction's surface, beyond caps and grid. Layer: surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rholm/fields.h"
#include "rholm/simplify.h"
#include "rholm/vec3.h"

namespace rholm {

// Treatment of places without points.
enum class HolePolicy {
  kFill,  // they are closed smoothly
  kKeep   // they are cut open
};
EnumNames names_of(HolePolicy policy);  // "fill", "keep"

// Cubes of space that lines of sight to the points pass through.
struct SeenCubes {
  Vec3 origin;      // lowest corner of the first cube
  double edge = 0;  // edge length of a cube
  // Number of cubes along x, y and z, 3 ... 256 each.
  std::array<std::size_t, 3> size = {};
  // One bit per cube, lowest bit first, x fastest: 1 if a line of sight passes through.
  std::vector<std::uint8_t> bits;
};

// Rules of a surface that reconstruct() extracted from its caps. With them synthesize() makes the
// same surface again: to the bit at the grid's own step, if there was a single tile.
struct SurfaceRules {
  HolePolicy holes = HolePolicy::kFill;          // as ReconstructOptions::holes
  double min_component = 0.01;                   // as ReconstructOptions::min_component
  std::optional<SimplifyOptions> simplify = {};  // as ReconstructOptions::simplify
  // Places where handles were searched for, with the spacing of the points there: handles smaller
  // than the spacing are cut (method 7.9).
  std::vector<Vec3> spacing_places = {};
  std::vector<double> spacings = {};   // one per place
  std::optional<SeenCubes> seen = {};  // holes are not closed across them (method 7.13)
  // True if the surface was made in several tiles. synthesize() then gives vertices and faces in
  // another order, and closed holes may differ by some steps of the grid.
  bool tiles = false;
  // Attributes of the surface that came from the points. A model does not store their values.
  std::vector<std::string> left_out = {};
};

}  // namespace rholm
