// Lattice for copies of a texture. Layer: edit.
#pragma once

#include "edit/texture/detail_map.h"

namespace rholm {

// Copies are placed at all i a + j b. b lies about 60 degrees to the left of a.
struct TileLattice {
  Place2 a, b;
};

// Searches nearly hexagonal lattices on which discs of this radius (at most 1, in the map's
// unit) leave no gap. Returns the one whose neighbouring copies agree best where they overlap.
TileLattice find_lattice(const DetailMap& map, double radius);

}  // namespace rholm
