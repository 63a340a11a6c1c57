// Repeats a texture over the plane. Layer: edit.
#pragma once

#include <vector>

#include "edit/texture/detail_map.h"
#include "edit/texture/tile_lattice.h"

namespace rholm {

// Heights with periods a and b of a lattice: n x n samples of one cell, at (i a + j b) / n.
struct RepeatedMap {
  TileLattice lattice;
  int n = 0;
  std::vector<double> values;

  // Interpolates samples by cubic convolution (Catmull-Rom): slopes are continuous.
  double operator()(const Place2& at) const;
};

// Repeats the map's unit disc. Copies are placed where neighbours agree best, and meet along
// lines of least difference. They fade into each other within a part of the texture's waves.
RepeatedMap repeat(const DetailMap& map);

}  // namespace rholm
