// Preparation of a mesh for expansions and caps. Layer: shape.
#pragma once

#include "rholm/topology.h"

namespace rholm {

// A welded mesh that is oriented outwards.
struct Outward {
  Welded welded;         // by weld()
  bool flipped = false;  // true if the closed mesh was inside out and flip() turned it
};

// Welds a mesh, and turns it if it is closed, consistently oriented and inside out. Other meshes
// are only welded. `tolerance` is as in weld(); throws as weld().
Outward outward(const Mesh& mesh, double tolerance = 0);

}  // namespace rholm
