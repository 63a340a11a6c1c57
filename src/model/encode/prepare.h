// A mesh made fit for expansion: welded, turned outwards, its edges paired. Layer: model.
#pragma once

#include <vector>

#include "rholm/outward.h"
#include "rholm/topology.h"

namespace rholm {

struct PreparedMesh {
  Outward shape;            // without attributes and thin faces
  std::vector<Edge> edges;  // of the welded mesh
};

// The mesh must be valid. Throws InvalidInput if it is not closed and oriented alike, as
// pair_edges().
PreparedMesh prepare(const Mesh& mesh, double weld_tolerance);

}  // namespace rholm
