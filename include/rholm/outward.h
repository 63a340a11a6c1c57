// A mesh as expansions and caps need it. Layer: shape.
#pragma once

#include "rholm/topology.h"

namespace rholm {

// A mesh that is welded, and faces outwards.
struct Outward {
  Welded welded;         // by weld()
  bool flipped = false;  // the closed mesh was inside out, and has been turned by flip()
};

// Welds a mesh and turns it if it is closed, oriented alike and inside out. Other meshes are only
// welded. `tolerance` is that of weld(), and so are the errors thrown.
Outward outward(const Mesh& mesh, double tolerance = 0);

}  // namespace rholm
