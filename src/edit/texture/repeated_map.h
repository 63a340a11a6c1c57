// A texture laid side by side with itself, everywhere. Layer: edit.
#pragma once

#include <vector>

#include "edit/texture/detail_map.h"
#include "edit/texture/tile_lattice.h"

namespace rholm {

// Heights that repeat along a and b of a lattice; n x n samples of one cell, at (i a + j b) / n.
struct RepeatedMap {
  TileLattice lattice;
  int n = 0;
  std::vector<double> values;

  // Between samples by cubic convolution (Catmull-Rom): slopes are continuous.
  double operator()(const Place2& at) const;
};

// Of the map's unit disc. Copies lie where neighbours agree best, meet along the lines where they
// differ least, and fade into one another within a part of the texture's own waves.
RepeatedMap repeat(const DetailMap& map);

}  // namespace rholm
