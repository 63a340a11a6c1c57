// What a reconstruction knows of its surface beyond the caps and the grid. Layer: surface.
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

// What becomes of places without points.
enum class HolePolicy {
  kFill,  // they are closed smoothly
  kKeep   // they are cut open
};
EnumNames names_of(HolePolicy policy);  // "fill", "keep"

// Cubes of space that lines of sight to the points go through.
struct SeenCubes {
  Vec3 origin;      // lowest corner of the first cube
  double edge = 0;  // of a cube
  // Cubes along x, y and z, 3 ... 256 each.
  std::array<std::size_t, 3> size = {};
  // A bit for each cube, lowest first, x fastest: 1 if it has been seen.
  std::vector<std::uint8_t> bits;
};

// How reconstruct() made the surface of its caps. With these rules synthesize() makes the same
// surface again: to the bit at the grid's own step, if it was not made in tiles.
struct SurfaceRules {
  HolePolicy holes = HolePolicy::kFill;          // as ReconstructOptions::holes
  double min_component = 0.01;                   // as ReconstructOptions::min_component
  std::optional<SimplifyOptions> simplify = {};  // as ReconstructOptions::simplify
  // Where handles were looked for, and the distances between neighbouring points there: smaller
  // handles are cut (method 7.9).
  std::vector<Vec3> spacing_places = {};
  std::vector<double> spacings = {};   // one per place
  std::optional<SeenCubes> seen = {};  // holes are not closed across them (method 7.13)
  // The surface was made in tiles. synthesize() gives its vertices and faces in another order, and
  // what closes holes may differ by some steps of the grid.
  bool tiles = false;
  // Attributes of the surface that came from the points. A model does not hold them.
  std::vector<std::string> left_out = {};
};

}  // namespace rholm
