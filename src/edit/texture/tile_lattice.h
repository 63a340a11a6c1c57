// Where copies of a texture go. Layer: edit.
#pragma once

#include "edit/texture/detail_map.h"

namespace rholm {

// Copies are laid at all i a + j b. b lies about 60 degrees to the left of a.
struct TileLattice {
  Place2 a, b;
};

// Of the lattices that are hexagonal, more or less, and on which discs of that radius (at most 1,
// of the map's unit) leave no gap, the one whose neighbouring copies agree best where they overlap.
TileLattice find_lattice(const DetailMap& map, double radius);

}  // namespace rholm
